//! Sample points that are exchanged by what they do in training runs.

use super::*;

/// The root of the mean square of the errors of the training runs with so many exchanges.
fn error_of_training_runs(exchanges: usize, out: &Path, file: &Path) -> f64 {
    let text = EXPERIMENT
        .replace("test = [[2.0, 0.1]]", "test = [[1.0, 0.0], [3.0, 0.2]]")
        .replace("\"network\", \"linear\"", "\"network\"")
        .replace("\"position-velocity\", \"velocity-only\"", "\"position-velocity\"")
        .replace(
            "samples = [20, \"all\"]",
            &format!("samples = [10], exchanges = {exchanges}"),
        );
    let experiment = Experiment::parse(&text, file).expect("sound");
    train_one(&experiment, out);
    let rows = run::<2>(&experiment, out, &mut |_, _| true).expect("run");
    assert!(rows.iter().all(|row| (row.choice.way(), row.samples) == ("greedy", 10)));
    (rows.iter().map(|row| row.error.expect("frames").powi(2)).sum::<f64>() / rows.len() as f64).sqrt()
}

#[test]
fn exchanges_make_training_runs_better_and_are_the_same_every_time() {
    let (directory, file) = files();
    let out = directory.path().join("out");
    let error = |exchanges| error_of_training_runs(exchanges, &out, &file);
    let (none, some) = (error(0), error(12));
    assert!(some < none, "{some} {none}");
    assert_eq!(error(12), some);
}
