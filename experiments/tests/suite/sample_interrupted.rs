//! Ctrl-C during `parvi sample` leaves nothing behind.

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
