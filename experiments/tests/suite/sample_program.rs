//! `parvi sample` of a density that a program evaluates.

use std::path::Path;
use std::process::Output;

use crate::support::{assert_refused, command, files, stderr, value};

/// Samples what a program says in two dimensions, on so many threads, into x.csv.
fn sample(directory: &Path, program: &str, threads: &str) -> Output {
    sample_with("", directory, program, threads)
}

/// The same with flags.
fn sample_with(flags: &str, directory: &Path, program: &str, threads: &str) -> Output {
    let line = format!("sample --target program --dim 2 --particles 1000 --out x.csv {flags} --program");
    let arguments = line.split_whitespace().chain([program]);
    let mut command = command();
    command.current_dir(directory).env("RAYON_NUM_THREADS", threads);
    command.args(arguments).output().unwrap()
}

/// The program that is shown, or nothing where there is no Python.
fn shown() -> Option<String> {
    let python = std::process::Command::new("python3").arg("--version").output();
    python.is_ok().then(|| {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/programs/banana.py");
        format!("python3 '{file}'")
    })
}

#[test]
fn a_density_in_python_has_its_evidence_and_the_same_bits_on_any_number_of_threads() {
    let Some(program) = shown() else {
        return;
    };
    let particles = ["1", "3"].map(|threads| {
        let directory = tempfile::tempdir().unwrap();
        let output = sample(directory.path(), &program, threads);
        assert!(output.status.success(), "{}", stderr(&output));
        assert_eq!(value(&output, "outcome").unwrap(), "converged");
        let number = |key| value(&output, key).unwrap().parse::<f64>().unwrap();
        let off = number("log_evidence") - std::f64::consts::PI.ln();
        assert!(off.abs() < 4.0 * number("log_evidence_error"), "{off}");
        assert_eq!(files(directory.path()), ["x.csv"]);
        std::fs::read(directory.path().join("x.csv")).unwrap()
    });
    assert_eq!(particles[0], particles[1]);
}

/// An exponential law, which knows its densities alone.
const EXPONENTIAL: &str = "
import sys
for line in sys.stdin:
    what, *x = line.split()
    x = [float(c) for c in x]
    print('' if what == 'score' else -sum(x) if min(x) >= 0 else '-inf', flush=True)
";

/// A normal law whose score has the wrong sign.
const UPHILL: &str = "
import sys
for line in sys.stdin:
    what, *x = line.split()
    x = [float(c) for c in x]
    print(' '.join(map(str, x)) if what == 'score' else -0.5 * sum(c * c for c in x), flush=True)
";

/// What a run with flags on a program of this text prints, and what it says; nothing where there is no Python.
fn of_source(flags: &str, source: &str) -> Option<(Output, String)> {
    shown()?;
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("own.py"), source).unwrap();
    let output = sample_with(flags, directory.path(), "python3 own.py", "1");
    let said = stderr(&output);
    assert!(output.status.success(), "{said}");
    Some((output, said))
}

/// No number of steps makes the material follow it.
#[test]
fn options_of_moves_are_said_to_be_idle_where_the_score_is_no_gradient() {
    let Some((output, said)) = of_source("--steps 8 --spacing 0.5", UPHILL) else {
        return;
    };
    assert_eq!(value(&output, "outcome").unwrap(), "stalled");
    let expected = "--steps, --spacing: without effect: none is moved where";
    assert!(said.starts_with(expected), "{said}");
}

/// Half of a normal law, which has no score within 0.004 of its edge, where some of 1,000 particles are.
const HALF: &str = "
import sys
for line in sys.stdin:
    what, *x = line.split()
    x = [float(c) for c in x]
    score = [-x[0] - 1, -x[1]] if x[0] > 0.004 else ['nan', 'nan']
    density = -0.5 * (x[0] * x[0] + x[1] * x[1]) - x[0] if x[0] > 0 else '-inf'
    print(*(score if what == 'score' else [density]), flush=True)
";

/// Particles of the pool were not pulled anywhere.
#[test]
fn scores_that_are_not_finite_beside_an_edge_move_no_particle() {
    if let Some((output, said)) = of_source("", HALF) {
        assert_eq!(value(&output, "steps").unwrap(), "0");
        assert!(
            said.starts_with("scores that were not finite at the particles: "),
            "{said}"
        );
        assert!(!said.contains("pulled back"), "{said}");
    }
}

/// Differences across the edge are no scores of the particles beside it.
#[test]
fn a_density_with_an_edge_has_diagnostics() {
    if shown().is_none() {
        return;
    }
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("exponential.py"), EXPONENTIAL).unwrap();
    let line = "sample --target program --dim 1 --particles 4000 --seed 2 --out x.csv --diagnostics d.json --program";
    let arguments = line.split_whitespace().chain(["python3 exponential.py"]);
    let output = command()
        .current_dir(directory.path())
        .args(arguments)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let found = std::fs::read_to_string(directory.path().join("d.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&found).unwrap();
    assert!(found["kernel_stein_discrepancy"].is_null(), "{found}");
    let mean = found["coordinates"][0]["mean"]["value"].as_f64().unwrap();
    assert!((mean - 1.0).abs() < 0.05, "{mean}");
}

#[test]
fn what_is_wrong_with_a_program_is_said_with_the_question() {
    let ending = "for n in 1 2 3 4 5 6 7 8 9; do read what x; if [ x$what = xscore ]; then echo 0 0; else echo -$n; fi; done; exit 7";
    for (program, parts) in [
        (
            "exit 3",
            [
                "--program: program `exit 3` ended (exit status: 3)",
                "`density 0e0 0e0`",
            ],
        ),
        (
            "while read x; do echo one; done",
            [
                "--program: ",
                "answers `density 0e0 0e0` with 'one', which is not a number",
            ],
        ),
        (
            "while read x; do echo 1; done",
            ["--program: ", "answers `score 0e0 0e0` with 1 number, not 2"],
        ),
        (" ", ["--program: ", "is an empty command line"]),
        (ending, ["ended (exit status: 7)", "without an answer to `"]),
    ] {
        let directory = tempfile::tempdir().unwrap();
        let output = sample(directory.path(), program, "2");
        assert_refused(&output, &parts);
        // What fails in the course of a run is no error of the line.
        assert_eq!(output.status.code(), Some(if program == ending { 1 } else { 2 }));
        assert_eq!(files(directory.path()), [""; 0], "{program}");
    }
}

/// The program that diagnostics start anew is a failing one.
#[test]
fn a_program_that_fails_after_the_run_leaves_no_diagnostics() {
    let Some(program) = shown() else {
        return;
    };
    let failing = "if [ -e begun ]; then read x; echo 0; read x; echo 0 0; exit 5; fi";
    let program = format!("{failing}; : > begun; exec {program}");
    let directory = tempfile::tempdir().unwrap();
    let output = sample_with("--diagnostics x.json", directory.path(), &program, "1");
    assert_refused(&output, &["ended (exit status: 5) without an answer to `score "]);
    assert_eq!(files(directory.path()), ["begun", "x.csv"]);
}
