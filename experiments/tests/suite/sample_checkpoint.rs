//! A run that was killed goes on from its checkpoint to the same file.

#![cfg(unix)]

use std::path::Path;
use std::time::Duration;

use crate::support::{assert_refused, files, parvi, started, stderr, stdout, succeeds, value};

const RUN: &str =
    "sample --target mixture-2 --dim 2 --particles 400 --evaluations 3000 --rounds 1 --steps 4000 --seed 3";

/// Runs until the checkpoint exists and `more` has passed, then kills the process without a warning; false if it was faster.
fn killed(directory: &Path, more: Duration) -> bool {
    let line = format!("{RUN} --out x.npy --checkpoint state --checkpoint-every 8");
    let mut child = started(directory, &line, || directory.join("state").exists());
    std::thread::sleep(more);
    let running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    running
}

#[test]
fn a_killed_run_ends_with_the_same_file() {
    let directory = tempfile::tempdir().unwrap();
    let whole = succeeds(directory.path(), &format!("{RUN} --out whole.npy"));
    let mut kills = 0;
    for milliseconds in [0, 37, 110, 5, 260] {
        kills += usize::from(killed(directory.path(), Duration::from_millis(milliseconds)));
        if !directory.path().join("state").exists() {
            break;
        }
    }
    assert!(kills > 0, "it was never killed");
    let resumed = succeeds(
        directory.path(),
        &format!("{RUN} --out x.npy --checkpoint state --checkpoint-every 8"),
    );
    let read = |name: &str| std::fs::read(directory.path().join(name)).unwrap();
    assert!(read("x.npy") == read("whole.npy"));
    for key in ["score_evaluations", "residual", "outcome", "mean_error"] {
        assert_eq!(value(&resumed, key), value(&whole, key), "{key}");
    }
    assert!(!directory.path().join("state").exists());
}

/// What stands in the way of the last file: a directory under its name.
#[test]
fn a_finished_run_whose_files_cannot_be_written_keeps_its_checkpoint() {
    const RUN: &str = "sample --target banana --particles 100 --seed 3 --steps 20";
    let root = tempfile::tempdir().unwrap();
    let line = |name: &str| format!("{RUN} --out {name}.npy --plots p --checkpoint state");
    let whole = succeeds(root.path(), &format!("{RUN} --out whole.npy"));
    std::fs::create_dir_all(root.path().join("p/histogram.svg/x")).unwrap();
    let failed = parvi(root.path(), &line("x"));
    assert!(!failed.status.success());
    assert!(root.path().join("state").exists(), "{}", stderr(&failed));
    std::fs::remove_dir_all(root.path().join("p/histogram.svg")).unwrap();
    std::fs::remove_file(root.path().join("x.npy")).unwrap();
    let again = succeeds(root.path(), &line("x"));
    let read = |name: &str| std::fs::read(root.path().join(name)).unwrap();
    assert!(read("x.npy") == read("whole.npy"));
    for key in [
        "score_evaluations",
        "density_evaluations",
        "residual",
        "outcome",
        "log_evidence",
    ] {
        assert_eq!(value(&again, key), value(&whole, key), "{key}");
    }
    assert_eq!(files(root.path()), ["p", "whole.npy", "x.npy"]);
}

#[test]
fn what_does_not_fit_a_checkpoint_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let short = "sample --target banana --particles 50 --out x.csv";
    let refuse = |more: &str, parts: &[&str]| {
        let output = parvi(directory.path(), &format!("{short} {more}"));
        assert_refused(&output, parts);
        assert_eq!(stdout(&output), "");
    };
    refuse("--checkpoint state --method svgd", &["checkpoint", "svgd"]);
    refuse("--checkpoint missing/state", &["missing/state", "No such file"]);
    std::fs::write(directory.path().join("state"), "something else").unwrap();
    refuse("--checkpoint state", &["checkpoint", "state", "damaged"]);
    assert_eq!(files(directory.path()), ["state"]);
}

#[test]
fn one_file_in_two_roles_is_refused_and_kept() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("data.csv"), "y,a\n0,1\n1,2\n1,0\n0,3\n").unwrap();
    let before = std::fs::read(directory.path().join("data.csv")).unwrap();
    let line = "sample --target logistic --data data.csv --particles 20";
    for (files, parts) in [
        ("--out ./data.csv", ["data", "--out"]),
        ("--out x.csv --diagnostics x.csv", ["diagnostics", "--out"]),
        ("--out x.csv --checkpoint data.csv", ["data", "--checkpoint"]),
    ] {
        assert_refused(&parvi(directory.path(), &format!("{line} {files}")), &parts);
    }
    assert_eq!(std::fs::read(directory.path().join("data.csv")).unwrap(), before);
    assert_eq!(files(directory.path()), ["data.csv"]);
}
