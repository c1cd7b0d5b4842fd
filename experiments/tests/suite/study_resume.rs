//! A study that was cut off goes on where it stopped and ends with the same results.

use std::path::Path;

use crate::support::{assert_refused, files, interrupted, parvi, stderr, succeeds, value};

const STUDY: &str = r#"
kind = "time-error"
seeds = [0]
threads = 1
particles = 64
steps = [2, 4]
reference-points = 1000
reference-seed = 7
directions = 8
targets = [{ name = "gaussian", dim = 2 }, { name = "banana" }, { name = "schools", dim = 3 }]
methods = [{ name = "mpm" }, { name = "svgd" }, { name = "iid" }]
"#;

/// 3 targets × (2 methods × 2 numbers of steps + draws).
const CASES: usize = 15;

/// The rows of results.csv without the columns that depend on the machine.
fn results(directory: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_path(directory.join("results.csv")).unwrap();
    let kept: Vec<bool> = reader
        .headers()
        .unwrap()
        .iter()
        .map(|name| !name.starts_with("wall") && !name.starts_with("memory"))
        .collect();
    let pick = |record: csv::StringRecord| {
        record
            .iter()
            .zip(&kept)
            .filter(|(_, keep)| **keep)
            .map(|(cell, _)| cell.to_owned())
            .collect()
    };
    reader.records().map(|record| pick(record.unwrap())).collect()
}

fn run(root: &Path, out: &str) {
    succeeds(root, &format!("run study.toml --out {out}"));
}

#[test]
fn a_torn_study_ends_with_the_same_results() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("study.toml"), STUDY).unwrap();
    run(root.path(), "torn");
    let whole = results(&root.path().join("torn"));
    assert_eq!(whole.len(), CASES);
    let path = root.path().join("torn/results.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    for kept in [0, 20, text.len() / 3, 2 * text.len() / 3, text.len() - 1] {
        std::fs::write(&path, &text[..kept]).unwrap();
        run(root.path(), "torn");
        assert_eq!(results(&root.path().join("torn")), whole, "cut at byte {kept}");
    }
    let manifest = std::fs::read_to_string(root.path().join("torn/manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(manifest["resumed"].as_array().unwrap().len(), 5);
}

#[test]
fn no_row_is_added_under_the_columns_of_another_version() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("study.toml"), STUDY).unwrap();
    run(root.path(), "out");
    let file = |name: &str| root.path().join("out").join(name);
    let text = std::fs::read_to_string(file("results.csv")).unwrap();
    let columns: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let manifest = std::fs::read(file("manifest.json")).unwrap();
    let (mut fewer, mut swapped) = (columns.clone(), columns.clone());
    fewer.pop();
    swapped.swap(3, 4);
    for header in [fewer, swapped] {
        let header = header.join(",") + "\n";
        std::fs::write(file("results.csv"), &header).unwrap();
        assert_refused(
            &parvi(root.path(), "run study.toml --out out"),
            &["results.csv has other columns than", "untouched"],
        );
        assert_eq!(std::fs::read_to_string(file("results.csv")).unwrap(), header);
        assert_eq!(std::fs::read(file("manifest.json")).unwrap(), manifest);
    }
    // Nothing is added to a study that is complete.
    let renamed = text.replacen("mass_error", "mass_errors", 1);
    assert_ne!(renamed, text);
    std::fs::write(file("results.csv"), renamed).unwrap();
    run(root.path(), "out");
}

#[test]
fn a_finished_study_is_not_run_again_and_its_report_needs_the_raw_results_alone() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("study.toml"), STUDY).unwrap();
    run(root.path(), "out");
    let out = root.path().join("out");
    let before = std::fs::read(out.join("results.csv")).unwrap();
    run(root.path(), "out");
    assert_eq!(std::fs::read(out.join("results.csv")).unwrap(), before);
    assert_eq!(
        files(&out),
        [
            "config.toml",
            "figures",
            "manifest.json",
            "raw",
            "report.md",
            "results.csv"
        ]
    );
    let report = std::fs::read_to_string(out.join("report.md")).unwrap();
    let figures = files(&out.join("figures"));
    assert!(!figures.is_empty());
    assert!(figures.iter().all(|name| report.contains(name.as_str())));
    let drawing = std::fs::read(out.join("figures").join(&figures[0])).unwrap();

    std::fs::remove_file(out.join("report.md")).unwrap();
    std::fs::remove_dir_all(out.join("figures")).unwrap();
    let output = succeeds(root.path(), "report out");
    assert_eq!(std::fs::read_to_string(out.join("report.md")).unwrap(), report);
    assert_eq!(std::fs::read(out.join("figures").join(&figures[0])).unwrap(), drawing);
    assert_eq!(value(&output, "study").unwrap(), "time-error");
}

#[test]
fn data_that_have_changed_are_another_study() {
    let root = tempfile::tempdir().unwrap();
    let of =
        "targets = [{ name = \"logistic\", parameters = { data = \"data.csv\" } }]\nmethods = [{ name = \"svgd\" }]\n";
    let head = STUDY.split("targets").next().unwrap();
    std::fs::write(root.path().join("study.toml"), format!("{head}{of}")).unwrap();
    let data = root.path().join("data.csv");
    std::fs::write(&data, "y,a\n0,1\n1,2\n1,0\n0,3\n").unwrap();
    run(root.path(), "out");
    run(root.path(), "out");
    let before = std::fs::read(root.path().join("out/results.csv")).unwrap();
    std::fs::write(&data, "y,a\n0,1\n1,2\n1,0\n0,4\n").unwrap();
    let output = parvi(root.path(), "run study.toml --out out");
    assert_refused(
        &output,
        &[
            "study.toml",
            "targets.parameters",
            "data.csv has changed since this study began",
        ],
    );
    assert_eq!(std::fs::read(root.path().join("out/results.csv")).unwrap(), before);
}

#[cfg(unix)]
#[test]
fn a_program_that_has_changed_is_another_study() {
    let root = tempfile::tempdir().unwrap();
    let of = "targets = [{ name = \"program\", dim = 2, parameters = { program = \"sh ./flat.sh\" } }]\n\
              methods = [{ name = \"svgd\" }]\n";
    let head = STUDY.split("targets").next().unwrap();
    std::fs::write(root.path().join("study.toml"), format!("{head}{of}")).unwrap();
    let program = root.path().join("flat.sh");
    let answering = |density: &str| {
        let text = format!("while read what x; do case $what in density) echo {density};; *) echo 0 0;; esac; done\n");
        std::fs::write(&program, text).unwrap();
    };
    answering("nan");
    run(root.path(), "out");
    run(root.path(), "out");
    let before = std::fs::read(root.path().join("out/results.csv")).unwrap();
    answering("-inf");
    let output = parvi(root.path(), "run study.toml --out out");
    assert_refused(
        &output,
        &[
            "study.toml",
            "targets.parameters",
            "./flat.sh has changed since this study began",
        ],
    );
    assert_eq!(std::fs::read(root.path().join("out/results.csv")).unwrap(), before);
}

#[cfg(unix)]
#[test]
fn a_target_that_answers_nan_does_not_end_a_study() {
    let program = "while read what x; do if [ $what = density ]; then echo nan; else echo 0 0; fi; done";
    let of = format!(
        "targets = [{{ name = \"program\", dim = 2, parameters = {{ program = \"{program}\" }} }}, {{ name = \"banana\" }}]\n\
         methods = [{{ name = \"svgd\" }}]\n"
    );
    let root = tempfile::tempdir().unwrap();
    let head = STUDY.split("targets").next().unwrap();
    std::fs::write(root.path().join("study.toml"), format!("{head}{of}")).unwrap();
    let output = succeeds(root.path(), "run study.toml --out out");
    assert_eq!(value(&output, "no_reference").as_deref(), Some("2"));
    let rows = crate::support::rows(root.path());
    let ends: Vec<&str> = rows.iter().map(|row| row["status"].as_str()).collect();
    assert_eq!(ends, ["no-reference", "no-reference", "finished", "finished"]);
    assert!(rows[0]["note"].contains("NaN"), "{rows:?}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_can_be_resumed() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(
        root.path().join("study.toml"),
        STUDY.replace("seeds = [0]", "seeds = [0, 1, 2, 3]"),
    )
    .unwrap();
    run(root.path(), "whole");
    // Some rows, so that the interruption falls into the middle.
    let path = root.path().join("out/results.csv");
    let output = interrupted(root.path(), "run study.toml --out out", || {
        std::fs::read_to_string(&path).map_or(0, |text| text.lines().count()) >= 6
    });
    assert!(stderr(&output).contains("resumes"), "{}", stderr(&output));
    let whole = results(&root.path().join("whole"));
    let part = results(&root.path().join("out"));
    assert!(part.len() >= 5 && part.len() < whole.len(), "{} rows", part.len());
    run(root.path(), "out");
    assert_eq!(results(&root.path().join("out")), whole);
}
