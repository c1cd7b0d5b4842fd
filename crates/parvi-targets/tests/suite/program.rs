//! Densities that programs evaluate; here these are loops of the shell.

use parvi_targets::{CatalogueTarget, ProgramTarget, Target, TargetError};
use proptest::prelude::*;
use rayon::prelude::*;

/// A loop that answers to `density` and to `score` with what the commands print, x the first coordinate and rest the others.
fn answering(density: &str, score: &str) -> String {
    format!("while read what x rest; do case $what in density) {density};; score) {score};; esac; done")
}

fn start<const D: usize>(command: &str) -> Result<ProgramTarget<D>, TargetError> {
    ProgramTarget::start(command)
}

fn refused(command: &str) -> String {
    match start::<2>(command) {
        Err(error @ TargetError::ProgramFailed { .. }) => error.to_string(),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("`{command}` was accepted"),
    }
}

#[test]
fn numbers_go_both_ways_with_all_their_digits() {
    let echo = start::<3>(&answering("echo $x", "echo $x $rest")).unwrap();
    assert!(echo.has_score());
    let config = ProptestConfig {
        failure_persistence: None,
        cases: 64,
        ..ProptestConfig::default()
    };
    proptest!(config, |(x in prop::array::uniform3(prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO))| {
        prop_assert_eq!(echo.log_density(&x).to_bits(), x[0].to_bits());
        prop_assert_eq!(echo.score(&x), x);
    });
    assert_eq!(echo.fault(), None);
}

#[test]
fn infinities_and_nan_are_numbers_and_commas_may_stand_between() {
    let target = start::<2>(&answering("echo -inf", "echo NaN, inf")).unwrap();
    assert_eq!(target.log_density(&[0.0, 1.0]), f64::NEG_INFINITY);
    let score = target.score(&[0.0, 1.0]);
    assert!(score[0].is_nan() && score[1] == f64::INFINITY);
    assert_eq!(target.fault(), None);
}

#[test]
fn an_empty_line_for_a_score_is_a_density_alone() {
    let target = start::<1>(&answering("echo $x", "echo")).unwrap();
    assert!(!target.has_score());
    assert!((target.score(&[0.3])[0] - 1.0).abs() < 1e-9);
}

#[test]
fn more_points_than_go_ahead_are_answered_in_order_from_any_thread() {
    let target = start::<2>(&answering("echo $x", "echo $x $rest")).unwrap();
    let xs: Vec<[f64; 2]> = (0..300).map(|n| [f64::from(n), -0.5 * f64::from(n)]).collect();
    let check = |_| {
        let (mut densities, mut scores) = (vec![0.0; 300], vec![[0.0; 2]; 300]);
        target.log_densities(&xs, &mut densities);
        target.scores(&xs, &mut scores);
        assert!(densities.iter().zip(&xs).all(|(density, x)| *density == x[0]));
        assert_eq!(scores, xs);
    };
    (0..4).into_par_iter().for_each(check);
    assert_eq!(target.fault(), None);
}

#[test]
fn what_is_no_program_is_refused() {
    for (command, parts) in [
        ("exit 3", ["ended (exit status: 3)", "`density 0e0 0e0`"]),
        (
            "no-such-program 2> /dev/null",
            ["ended (exit status: 127)", "without an answer"],
        ),
        (
            "echo hello; cat",
            ["`density 0e0 0e0`", "'hello', which is not a number"],
        ),
        (
            "while read x; do echo 1 2 3; done",
            ["`density 0e0 0e0`", "3 numbers, not 1"],
        ),
        ("while read x; do echo 1; done", ["`score 0e0 0e0`", "1 number, not 2"]),
        ("while read x; do echo; done", ["`density 0e0 0e0`", "an empty line"]),
    ] {
        let message = refused(command);
        assert!(message.starts_with(&format!("program `{command}` ")), "{message}");
        for part in parts {
            assert!(message.contains(part), "{message}: {part}");
        }
    }
}

/// Answers to five questions.
const ENDING: &str =
    "for n in 1 2 3 4 5; do read what x; if [ x$what = xscore ]; then echo 0 0; else echo $n; fi; done; exit 7";

#[test]
fn a_program_that_ends_is_a_fault_and_its_values_are_none_from_then_on() {
    // Two questions at the beginning, and three more.
    let three = start::<2>(ENDING).unwrap();
    let mut densities = [0.0; 5];
    three.log_densities(&[[1.0, 2.0]; 3], &mut densities[..3]);
    assert_eq!(densities[..3], [3.0, 4.0, 5.0]);
    three.log_densities(&[[1.0, 2.0]; 5], &mut densities);
    assert!(densities.iter().all(|density| density.is_nan()));
    let fault = three.fault().unwrap().to_string();
    assert!(
        fault.contains("ended (exit status: 7) without an answer to `density 1e0 2e0`"),
        "{fault}"
    );
    assert!(three.log_density(&[0.0; 2]).is_nan() && three.score(&[0.0; 2])[0].is_nan());
    assert_eq!(three.fault().unwrap().to_string(), fault);
}

/// A density of a coordinate that is said once more at the question of this number, before the answer or after it.
fn saying_more(at: usize, before: &str, after: &str) -> String {
    let answer = "if [ $what = score ]; then echo 0 0; else echo $x; fi";
    let more = |text: &str| match text {
        "" => ":".to_owned(),
        text => format!("if [ $n = {at} ]; then echo {text}; fi"),
    };
    let (before, after) = (more(before), more(after));
    format!("n=0; while read what x rest; do n=$((n+1)); {before}; {answer}; {after}; done")
}

#[test]
fn a_line_too_many_is_a_fault_before_it_shifts_answers_or_at_the_end() {
    for (before, after) in [("7", ""), ("", "7"), ("", "seven")] {
        let target = start::<2>(&saying_more(40, before, after)).unwrap();
        let xs: Vec<[f64; 2]> = (0..200).map(|n| [f64::from(n), 0.0]).collect();
        let mut densities = vec![0.0; xs.len()];
        for _ in 0..5 {
            target.log_densities(&xs, &mut densities);
        }
        // What line it is depends on when it is noticed, but that it is one too many is certain.
        let fault = target.fault().unwrap().to_string();
        let is_noticed = fault.contains("beside its answers") || fault.contains("'seven', which is not a number");
        assert!(is_noticed, "{fault}");
        assert!(target.log_density(&[0.0; 2]).is_nan());
    }
}

#[test]
fn the_last_line_too_many_is_named_at_the_end() {
    // Two questions at the beginning, and one more.
    let target = start::<2>(&saying_more(3, "", "7")).unwrap();
    assert_eq!(target.log_density(&[5.0, 0.0]), 5.0);
    let fault = target.fault().unwrap().to_string();
    assert!(
        fault.contains("prints '7' beside its answers, which are one line for every question"),
        "{fault}"
    );
    let sound = start::<2>(&saying_more(0, "", "7")).unwrap();
    assert_eq!(sound.log_density(&[5.0, 0.0]), 5.0);
    assert_eq!(sound.fault(), None);
    assert_eq!(
        sound.log_density(&[6.0, 0.0]),
        6.0,
        "a program that was ended is begun anew"
    );
}

#[test]
fn nothing_of_a_command_line_goes_on_after_the_end() {
    let directory = tempfile::tempdir().unwrap();
    let late = directory.path().join("late");
    // The shell waits for a shell of its own, which goes on for longer than it is waited for after its input has ended.
    let answers = "while read what rest; do if [ $what = score ]; then echo; else echo 0; fi; done";
    let line = format!("sh -c '{answers}; sleep 3; : > \"$0\"' '{}'; true", late.display());
    drop(start::<2>(&line).unwrap());
    std::thread::sleep(std::time::Duration::from_secs(2));
    assert!(!late.exists());
}
