//! Runs the built command and looks at what it says and leaves.

#![allow(dead_code)]

use std::collections::HashMap;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// The built command.
pub fn command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_parvi"));
    command.env("RAYON_NUM_THREADS", "2");
    command
}

/// Runs `parvi` with arguments separated by spaces in a directory.
pub fn parvi(directory: &Path, arguments: &str) -> Output {
    command()
        .current_dir(directory)
        .args(arguments.split_whitespace())
        .output()
        .unwrap()
}

/// As [`parvi`], and asserts that it succeeds.
pub fn succeeds(directory: &Path, arguments: &str) -> Output {
    let output = parvi(directory, arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    output
}

/// As [`parvi`], but comes back when `begun` has become true, or when the command has ended before.
pub fn started(directory: &Path, arguments: &str, begun: impl Fn() -> bool) -> Child {
    let mut child = command()
        .current_dir(directory)
        .args(arguments.split_whitespace())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !begun() && child.try_wait().unwrap().is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "it does not begin");
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

/// As [`parvi`], with Ctrl-C as soon as `begun` has become true, and asserts that this is how it ended.
pub fn interrupted(directory: &Path, arguments: &str, begun: impl Fn() -> bool) -> Output {
    let mut child = started(directory, arguments, begun);
    assert!(
        child.try_wait().unwrap().is_none(),
        "it ended before it was interrupted"
    );
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(kill.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    output
}

/// Standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Standard error as text.
pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The value of a `key=value` line.
pub fn value(output: &Output, key: &str) -> Option<String> {
    let text = stdout(output);
    text.lines()
        .find_map(|line| line.strip_prefix(key)?.strip_prefix('=').map(str::to_owned))
}

/// The names of all files of a directory, hidden ones included, in order.
pub fn files(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Asserts that a command failed with one clear message that holds all `parts`, wrote nothing to standard output and did
/// not panic.
pub fn assert_refused(output: &Output, parts: &[&str]) {
    let message = stderr(output);
    assert!(!output.status.success(), "it succeeded: {message}");
    assert!(output.status.code().is_some(), "it was ended by a signal: {message}");
    assert!(!message.contains("panicked"), "{message}");
    assert!(message.starts_with("error: "), "{message}");
    assert_eq!(stdout(output), "");
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

/// Runs a configuration as `study.toml` into `out` of a new directory and asserts that it succeeds.
pub fn run_study(text: &str) -> (tempfile::TempDir, Output) {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("study.toml"), text).unwrap();
    let output = succeeds(root.path(), "run study.toml --out out");
    (root, output)
}

/// Asserts that the report exists, that it links to all figures, and that no figure was left out.
pub fn assert_report(root: &Path, figures: usize) -> String {
    let report = std::fs::read_to_string(root.join("out/report.md")).unwrap();
    let is_name = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_lowercase() || "-.".contains(c));
    let mut braced = report.split('{').skip(1).filter_map(|rest| rest.split_once('}'));
    let unfilled = braced.find(|(text, _)| is_name(text));
    assert_eq!(unfilled, None, "a place of the prose without a value");
    assert!(!report.contains("The prose has no `"), "{report}");
    let names = files(&root.join("out/figures"));
    assert!(
        names.iter().all(|name| report.contains(&format!("(figures/{name})"))),
        "{report}"
    );
    assert_eq!(names.len(), figures, "{report}");
    assert!(report.contains("Provenance"));
    assert!(!report.contains("NaN"), "{report}");
    report
}

/// Asserts that a text holds all of these.
pub fn assert_holds(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part} is missing in {text}");
    }
}

/// Asserts that a study with one text replaced is refused before anything is written.
pub fn refused(study: &str, from: &str, to: &str, parts: &[&str]) {
    let root = tempfile::tempdir().unwrap();
    let text = study.replacen(from, to, 1);
    assert_ne!(text, study);
    std::fs::write(root.path().join("study.toml"), text).unwrap();
    let parts: Vec<&str> = parts.iter().copied().chain(["study.toml"]).collect();
    assert_refused(&parvi(root.path(), "run study.toml --out out"), &parts);
    assert_eq!(files(root.path()), ["study.toml"]);
}

/// Calls `check` with the cells of every line of a table: ` | ` is between them, and `\n` in one is a line break.
pub fn for_each_line(table: &str, check: impl Fn(&[&str])) {
    for line in table.lines().map(str::trim_start).filter(|line| !line.is_empty()) {
        let cells: Vec<String> = line.split(" | ").map(|cell| cell.replace("\\n", "\n")).collect();
        check(&cells.iter().map(String::as_str).collect::<Vec<_>>());
    }
}

/// [`refused`] for every line of a table: what is replaced, by what, and the parts of the message.
pub fn refused_lines(study: &str, table: &str) {
    for_each_line(table, |line| refused(study, line[0], line[1], &line[2..]));
}

/// Writes 40 rows of a response of 0 or 1 and of the covariates that the header names behind it, two at the most.
pub fn write_responses(file: &Path, header: &str) {
    let covariates = header.split(',').count() - 1;
    let row = |k: usize| {
        let numbers = [(k * 7) % 11, (k * 5) % 13].map(|number| format!(",{number}"));
        format!("{}{}\n", u8::from(k.is_multiple_of(3)), numbers[..covariates].concat())
    };
    let rows: String = (0..40).map(row).collect();
    std::fs::write(file, format!("{header}\n{rows}")).unwrap();
}

/// A directory with the particles `x.csv` of a regression on such data, sampled with some more flags.
pub fn sampled_regression(header: &str, flags: &str) -> tempfile::TempDir {
    let root = tempfile::tempdir().unwrap();
    write_responses(&root.path().join("d.csv"), header);
    let line = format!("sample --target logistic --data d.csv --particles 20 --steps 2 --out x.csv {flags}");
    succeeds(root.path(), line.trim());
    root
}

/// The records of results.csv, by the names of the columns.
pub fn rows(root: &Path) -> Vec<HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(root.join("out/results.csv")).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

/// A number of a record.
pub fn number(row: &HashMap<String, String>, name: &str) -> f64 {
    row[name]
        .parse()
        .unwrap_or_else(|_| panic!("{name} is missing in {row:?}"))
}

/// Runs a configuration and asserts that its report is whole; the directory, the output and the report.
pub fn reported(text: &str, figures: usize) -> (tempfile::TempDir, Output, String) {
    let (root, output) = run_study(text);
    let report = assert_report(root.path(), figures);
    (root, output, report)
}

/// Asserts that `parvi report` writes the same report.
pub fn assert_reports_again(root: &Path, report: &str) {
    succeeds(root, "report out");
    assert_eq!(std::fs::read_to_string(root.join("out/report.md")).unwrap(), report);
}

/// The header of a CSV file of numbers, and its rows.
pub fn numbers(path: &Path) -> (String, Vec<Vec<f64>>) {
    let text = std::fs::read_to_string(path).unwrap();
    let (header, lines) = text.split_once('\n').unwrap();
    let numbers = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
    (header.to_owned(), lines.lines().map(numbers).collect())
}

/// Asserts how many cases a study has, and how many of them failed.
pub fn assert_cases(output: &Output, cases: usize, failed: usize) {
    let stated = ["cases", "failed"].map(|key| value(output, key).unwrap());
    assert_eq!(stated, [cases, failed].map(|count| count.to_string()));
}
