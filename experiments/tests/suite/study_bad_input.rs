//! What `parvi run` and `parvi report` refuse, and that they leave everything as it was.

use std::path::Path;

use crate::support::{assert_refused, files, for_each_line, parvi, refused_lines, succeeds};

const STUDY: &str = r#"kind = "covariance-spacing"
seeds = [0]
particles = 100
method = { name = "mpm", options = { steps = 3 } }
series = [{ dim = 1, spacings = [1.0] }]
"#;

fn write(root: &Path, text: &str) {
    std::fs::write(root.join("study.toml"), text).unwrap();
}

/// Runs the study above with one text replaced and asserts that it was refused before anything was written.
fn refused(from: &str, to: &str, parts: &[&str]) {
    let root = tempfile::tempdir().unwrap();
    let text = STUDY.replace(from, to);
    assert_ne!(text, STUDY);
    write(root.path(), &text);
    assert_refused(&parvi(root.path(), "run study.toml --out out"), parts);
    assert_eq!(files(root.path()), ["study.toml"]);
}

#[test]
fn unknown_keys_and_kinds() {
    for_each_line(
        r#"
        seeds = [0] | seeds = [0]\ncolour = 3 | study.toml, line 3, column 1 | colour | particles | `kind`, `threads` (in
        covariance-spacing | covariance | study.toml, line 1 | `covariance` | quickstart
        kind = "covariance-spacing"\n |  | study.toml | kind
        steps = 3 | step = 3 | study.toml, line 4 | `step` | steps
        dim = 1, | dimension = 1, | study.toml, line 5 | `dimension`
        "#,
        |line| refused(line[0], line[1], &line[2..]),
    );
}

#[test]
fn sizes_out_of_range() {
    for_each_line(
        r#"
        particles = 100 | particles = -100 | study.toml, line 3, column 13 | -100 | particles = -100
        particles = 100 | particles = 1 | line 3 | 1 is out of range | from 2
        particles = 100 | particles = 1.5 | line 3 | 1.5
        particles = 100 | particles = "many" | line 3 | many
        dim = 1, | dim = 0, | line 5 | 0 is out of range | from 1 to 8
        dim = 1, | dim = 9, | line 5 | 9 is out of range | from 1 to 8
        steps = 3 | steps = 0 | line 4 | 0 is out of range
        steps = 3 | steps = 3, time-step = -1.0 | line 4 | time-step | -1
        [1.0] | [-1.0] | spacings | -1
        seeds = [0] | seeds = [] | study.toml | seeds | empty
        seeds = [0] | seeds = [0, 0] | study.toml: seeds, spacings or series: two cases are `d1-h1-s0`
        [1.0] | [1.0, 1.0] | two cases are `d1-h1-s0`
        "#,
        |line| refused(line[0], line[1], &line[2..]),
    );
}

#[test]
fn sizes_of_a_sweep_that_stand_there_twice() {
    refused_lines(
        include_str!("../../configs/scaling.toml"),
        r#"
        [100, 316, | [100, 100, | dims, particles or nodes-per-axis: two cases are `particles-d1-m100`
        [8, 32, | [8, 8, | two cases are `nodes-d2-m10000-k8`
        "#,
    );
}

#[test]
fn methods_and_their_options() {
    for_each_line(
        r#"
        "mpm" | "magic" | study.toml, line 4 | magic | paper-pic
        steps = 3 } } | steps = 3 }, largest-particles = 3 } | study.toml | largest-particles | leaves no case
        steps = 3 | steps = 3, youngs-modulus = 2 | line 4 | youngs-modulus | 2 | mpm
        "#,
        |line| refused(line[0], line[1], &line[2..]),
    );
}

#[test]
fn targets() {
    let root = tempfile::tempdir().unwrap();
    let quickstart = include_str!("../../configs/quickstart.toml");
    for (from, to, parts) in [
        (
            "name = \"wells\", dim = 5",
            "name = \"walls\", dim = 5",
            ["line", "walls"],
        ),
        ("name = \"wells\", dim = 5", "name = \"wells\", dim = 7", ["line", "7"]),
        ("name = \"wells\", dim = 5", "name = \"gaussian\"", ["line", "gaussian"]),
        (
            "{ name = \"banana\" }",
            "{ name = \"banana\", parameters = { radius = 3.0 } }",
            ["line", "radius"],
        ),
        (
            "{ name = \"banana\" }",
            "{ name = \"gaussian\", dim = 3 }",
            ["picture.target", "d = 3"],
        ),
        ("mean = 0.02", "mean = -0.02", ["bounds.mean", "-0.02"]),
    ] {
        let text = quickstart.replace(from, to);
        assert_ne!(text, quickstart);
        write(root.path(), &text);
        assert_refused(
            &parvi(root.path(), "run study.toml --out out"),
            &["study.toml", parts[0], parts[1]],
        );
        assert_eq!(files(root.path()), ["study.toml"]);
    }
}

#[test]
fn configurations_that_cannot_be_read() {
    let root = tempfile::tempdir().unwrap();
    assert_refused(&parvi(root.path(), "run nowhere.toml --out out"), &["nowhere.toml"]);
    write(root.path(), "kind = \n");
    assert_refused(&parvi(root.path(), "run study.toml --out out"), &["study.toml, line 1"]);
    std::fs::write(root.path().join("study.toml"), [0xff, 0xfe]).unwrap();
    assert_refused(&parvi(root.path(), "run study.toml --out out"), &["study.toml"]);
    assert_eq!(files(root.path()), ["study.toml"]);
}

#[test]
fn directories_of_others() {
    let root = tempfile::tempdir().unwrap();
    write(root.path(), STUDY);
    let out = root.path().join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("thesis.tex"), "precious").unwrap();
    assert_refused(
        &parvi(root.path(), "run study.toml --out out"),
        &["out", "thesis.tex", "untouched"],
    );
    assert_eq!(files(&out), ["thesis.tex"]);

    std::fs::rename(out.join("thesis.tex"), out.join("config.toml")).unwrap();
    assert_refused(
        &parvi(root.path(), "run study.toml --out out"),
        &["out", "config.toml", "untouched"],
    );
    assert_eq!(std::fs::read_to_string(out.join("config.toml")).unwrap(), "precious");
}

#[test]
fn directories_of_other_studies() {
    let root = tempfile::tempdir().unwrap();
    write(root.path(), STUDY);
    succeeds(root.path(), "run study.toml --out out");
    let before = std::fs::read(root.path().join("out/results.csv")).unwrap();
    write(root.path(), &STUDY.replace("particles = 100", "particles = 101"));
    assert_refused(
        &parvi(root.path(), "run study.toml --out out"),
        &["out", "another study", "untouched"],
    );
    assert_eq!(std::fs::read(root.path().join("out/results.csv")).unwrap(), before);
    // Comments and spaces are the same study.
    write(root.path(), &STUDY.replace("particles = 100", "particles  =  100 # M"));
    succeeds(root.path(), "run study.toml --out out");
}

#[test]
fn directories_that_cannot_be() {
    let root = tempfile::tempdir().unwrap();
    write(root.path(), STUDY);
    assert_refused(&parvi(root.path(), "run study.toml --out study.toml"), &["study.toml"]);
    assert_refused(
        &parvi(root.path(), "run study.toml --out study.toml/out"),
        &["study.toml/out"],
    );
    assert_refused(&parvi(root.path(), "run study.toml --out /proc/out"), &["/proc/out"]);
    assert_eq!(std::fs::read_to_string(root.path().join("study.toml")).unwrap(), STUDY);
}

#[test]
fn reports_of_nothing() {
    let root = tempfile::tempdir().unwrap();
    assert_refused(&parvi(root.path(), "report out"), &["cannot read out: "]);
    std::fs::create_dir(root.path().join("empty")).unwrap();
    assert_refused(&parvi(root.path(), "report empty"), &["empty", "holds no results"]);
    write(root.path(), STUDY);
    succeeds(root.path(), "run study.toml --out out");
    let path = root.path().join("out/results.csv");
    std::fs::write(&path, "case,status\nd1,fine\n").unwrap();
    assert_refused(&parvi(root.path(), "report out"), &["results.csv", "line"]);
    assert_refused(
        &parvi(root.path(), "run study.toml --out out"),
        &["results.csv", "line"],
    );
}
