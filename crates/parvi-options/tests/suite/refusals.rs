//! What cannot be asked for is refused with the option's name and value, wherever it stands.

use clap::Parser;
use parvi_options::{MethodName, MethodOptions, MethodSpecification, TargetSpecification};

#[derive(Parser)]
#[command(no_binary_name = true)]
struct Line {
    #[arg(long, value_enum)]
    method: MethodName,
    #[command(flatten)]
    options: MethodOptions,
}

/// What a command line is refused with.
fn of_flags(line: &str) -> String {
    let line = Line::try_parse_from(line.split_whitespace()).unwrap();
    line.options.method(line.method).unwrap_err().to_string()
}

/// What a table of a file is refused with.
fn of_table<T: serde::de::DeserializeOwned + std::fmt::Debug>(text: &str) -> String {
    toml::from_str::<T>(text).unwrap_err().message().to_owned()
}

#[test]
fn a_flag_and_a_key_are_refused_alike() {
    for (method, option, value, expected) in [
        ("svgd", "step-size", "-1", "step-size: -1 must be a number above 0"),
        (
            "mpm",
            "flip-share",
            "0.5",
            "flip-share: 0.5 needs the transfer `flip` or `affine-flip`",
        ),
        (
            "iid",
            "steps",
            "7",
            "steps: 7 does not fit method `iid`, which has no options of its own",
        ),
    ] {
        assert_eq!(of_flags(&format!("--method {method} --{option}={value}")), expected);
        let table = format!("name = \"{method}\"\noptions = {{ {option} = {value} }}");
        assert_eq!(of_table::<MethodSpecification>(&table), expected);
    }
}

#[test]
fn flags_say_the_same_as_the_table_that_they_come_from() {
    let table = "basis = \"cubic\"\nspacing = 0.5\nshifts = \"off\"\ndisplacement-limit = 0.25";
    let options: MethodOptions = toml::from_str(table).unwrap();
    let mut flags = vec!["--method".to_owned(), "mpm".to_owned()];
    flags.extend(options.flags());
    assert_eq!(Line::try_parse_from(flags).ok().unwrap().options, options);
}

#[test]
fn targets_that_there_are_not_are_refused_while_they_are_read() {
    let message = of_table::<TargetSpecification>("name = \"banana\"\ndim = 3");
    assert!(message.contains("banana"), "{message}");
    let message = of_table::<TargetSpecification>("name = \"gaussian\"\ndim = 9");
    assert_eq!(message, "9 is out of range: must be from 1 to 8");
}
