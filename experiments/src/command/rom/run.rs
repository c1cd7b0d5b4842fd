//! `parvi rom run`.

use std::path::Path;

use mpm_rom::experiment::{Experiment, ReducedRow, SuperResolved, run_experiment};

use super::{figures, groups};
use crate::progress::Bar;
use crate::{CommandError, console, interrupt};

/// Reduced runs of all test cases, their table and figures.
pub fn execute(experiment: &Experiment, directory: &Path) -> Result<(), CommandError> {
    let mut progress = Bar::counting("run");
    let result = run_experiment(experiment, directory, &mut |done, runs| {
        progress.set(done, runs);
        !interrupt::requested()
    });
    progress.clear();
    report(experiment, directory, &result?)
}

/// Figures and means of reduced runs.
pub fn report(experiment: &Experiment, directory: &Path, rows: &[ReducedRow]) -> Result<(), CommandError> {
    figures::errors(directory, &experiment.title, rows)?;
    figures::coordinates(directory, experiment, rows)?;
    for row in rows.iter().filter(|row| row.outcome != "finished") {
        console::notice(&format!(
            "case {}, {}{}, {} samples ({}), {}, {}, steps of {}: {}",
            row.case,
            row.manifold,
            variant(row),
            row.samples,
            row.chosen,
            row.quadrature,
            row.update,
            row.step_factor,
            row.outcome
        ));
    }
    let mut text = String::new();
    for group in groups(rows) {
        let mean = |value: fn(&ReducedRow) -> f64| group.iter().map(|row| value(row)).sum::<f64>() / group.len() as f64;
        let largest = group.iter().map(|row| row.error).fold(0.0, f64::max);
        text.push_str(&format!(
            "manifold={}{} samples={} choice={} quadrature={} update={} step_factor={} runs={} mean_error_percent={:.4} largest_error_percent={largest:.4} speed_up={:.2} real_time_factor={:.3}",
            group[0].manifold,
            variant(group[0]),
            group[0].samples,
            group[0].chosen,
            group[0].quadrature,
            group[0].update,
            group[0].step_factor,
            group.len(),
            mean(|row| row.error),
            mean(|row| row.full_seconds) / mean(|row| row.seconds),
            mean(|row| row.simulated) / mean(|row| row.seconds),
        ));
        if group[0].super_resolved.is_some() {
            let fine = |value: fn(&SuperResolved) -> f64| {
                let all = group.iter().filter_map(|row| row.super_resolved.as_ref());
                all.map(value).sum::<f64>() / group.len() as f64
            };
            text.push_str(&format!(
                " super_resolution_mean_error_percent={:.4} tracer_mean_error_percent={:.4}",
                fine(|fine| fine.error),
                fine(|fine| fine.tracer_error)
            ));
        }
        text.push('\n');
    }
    console::print(&text)
}

/// Which variant of the network it was, with a space before it.
fn variant(row: &ReducedRow) -> String {
    if row.variant.is_empty() {
        String::new()
    } else {
        format!(" variant={}", row.variant)
    }
}
