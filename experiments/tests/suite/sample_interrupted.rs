//! Ctrl-C during `parvi sample` leaves nothing behind but the checkpoint.

#![cfg(unix)]

use crate::support::{files, interrupted, stderr, stdout};

#[test]
fn an_interrupted_run_leaves_no_file() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target banana --particles 500 --steps 10000000 --out x.csv";
    // The temporary file shows that the run has begun.
    let output = interrupted(directory.path(), line, || !files(directory.path()).is_empty());
    assert!(
        stderr(&output).contains("interrupted after step"),
        "{}",
        stderr(&output)
    );
    assert_eq!(stdout(&output), "");
    assert_eq!(files(directory.path()), [""; 0]);
}

#[test]
fn an_interrupted_run_with_a_checkpoint_says_how_to_go_on() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target banana --particles 400 --evaluations 3000 --rounds 1 --steps 10000000 --out x.csv --checkpoint state --checkpoint-every 8";
    let output = interrupted(directory.path(), line, || directory.path().join("state").exists());
    let message = stderr(&output);
    let expected = ": the same command goes on from state";
    assert!(message.contains("interrupted after step"), "{message}");
    assert!(message.trim_end().ends_with(expected), "{message}");
    assert_eq!(files(directory.path()), ["state"]);
}
