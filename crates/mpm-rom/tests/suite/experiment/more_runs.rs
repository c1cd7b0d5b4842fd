//! A file that asks for other runs of what another file trains.

use super::*;

const MORE: &str = r#"
title = "A strip, again"
trained_as = "strip_rom.toml"
cases = { test = [[1.5, 0.1], [2.5, 0.1]] }
run = { samples = ["all"] }
"#;

/// What `MORE` is with a change, beside the experiment that it names.
fn with(change: (&str, &str)) -> Result<Experiment, ExperimentError> {
    let (directory, _) = files();
    let file = directory.path().join("more.toml");
    assert!(MORE.contains(change.0), "{change:?}");
    std::fs::write(&file, MORE.replace(change.0, change.1)).expect("written");
    Experiment::read(&file)
}

#[test]
fn everything_but_title_test_cases_and_runs_is_that_of_the_other_file() {
    let (directory, other) = files();
    let file = directory.path().join("more.toml");
    std::fs::write(&file, MORE).expect("written");
    let (trained, more) = (
        Experiment::read(&other).expect("sound"),
        Experiment::read(&file).expect("sound"),
    );
    assert_eq!((more.title.as_str(), more.cases.test.len()), ("A strip, again", 2));
    assert_eq!(more.run.samples, [SampleCount::All]);
    let cases = Cases {
        test: trained.cases.test.clone(),
        ..more.cases.clone()
    };
    assert_eq!(cases, trained.cases);
    assert_eq!(
        (&more.scene, &more.parameters, &more.keys),
        (&trained.scene, &trained.parameters, &trained.keys)
    );
    assert_eq!(
        (&more.training, &more.variants, more.starts),
        (&trained.training, &trained.variants, trained.starts)
    );
    assert_eq!(
        (more.recorded_points, more.frames_between),
        (trained.recorded_points, trained.frames_between)
    );
    // Its runs are made where the other one has been trained; and trained itself, it leaves the same file there.
    let results = directory.path().join("results");
    train_one(&trained, &results);
    let rows = run::<2>(&more, &results, &mut |_, _| true).expect("run");
    assert_eq!(rows.len(), 2);
    let anew = directory.path().join("anew");
    train_one(&more, &anew);
    let config = |directory: &Path| std::fs::read_to_string(directory.join(names::CONFIG)).expect("written");
    assert_eq!(config(&anew), config(&results));
    let titled = Experiment::read(&anew.join(names::CONFIG)).expect("sound");
    assert_eq!(titled.title, more.title);
}

#[test]
fn test_cases_that_are_left_out_are_those_of_the_other_file() {
    let more = with(("cases = { test = [[1.5, 0.1], [2.5, 0.1]] }", "")).expect("sound");
    assert_eq!(more.cases.test, [[2.0, 0.1]]);
}

#[test]
fn what_is_wrong_with_it_is_named() {
    for (change, expected) in [
        (("strip_rom.toml", "missing.toml"), "more.toml, trained_as: "),
        (
            ("strip_rom.toml", "more.toml"),
            "trained_as: more.toml names a further file",
        ),
        (
            ("strip_rom.toml", "../strip_rom.toml"),
            "trained_as: ../strip_rom.toml: a file beside this one",
        ),
        (("\"strip_rom.toml\"", "3"), "line 3"),
        (("run = {", "scene = \"strip.toml\"\nrun = {"), "unknown field `scene`"),
        (
            ("test = [[1.5, 0.1], [2.5, 0.1]]", "train = [[1.5, 0.1]]"),
            "unknown field `train`",
        ),
        (
            ("[2.5, 0.1]", "[2.5]"),
            "more.toml, cases.test.1: the number of values is 1, that of parameters 2",
        ),
        (
            ("samples = [\"all\"]", "samples = []"),
            "more.toml, run.samples: at least one",
        ),
    ] {
        let error = with(change).expect_err("refused").to_string();
        assert!(error.contains(expected), "{error}");
    }
}
