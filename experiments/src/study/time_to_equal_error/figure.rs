//! The figure of the study `time-to-equal-error`: squared energy distance against wall time, a panel per target.

use super::{RUNS, TimeToEqualError};
use crate::plots::{TimeErrorPanel, time_error};
use crate::study::contestant::runs_of;
use crate::study::prelude::*;

/// The method with a point per M; chains and independent draws with a point per number of draws; other rivals with a curve for every
/// M, a point per number of steps.
pub fn plot(
    study: &TimeToEqualError,
    rows: &Rows<'_>,
    directory: &StudyDirectory,
) -> Result<MultiplesPlot, CommandError> {
    let mut panels: Vec<TimeErrorPanel> = Vec::new();
    for (case, runs) in runs_of(study, rows, directory, RUNS)? {
        let settings = settings(&runs.iter().collect());
        if settings.is_empty() {
            continue;
        }
        let one_curve = case.index == 0 || !case.method.name.iterates() || study.particles.len() == 1;
        let size = if one_curve {
            String::new()
        } else {
            format!(", M = {}", case.particles)
        };
        let curve = format!("{}{size}", case.method.label());
        let known = TimeErrorPanel::settings(&mut panels, &case.target.label(), &curve);
        if case.index == 0 {
            known.extend(settings);
        } else if settings.len() > known.len() {
            // The runs of a chain for the larger M begin with those for the smaller one.
            *known = settings;
        }
    }
    Ok(time_error("wall time (s)", "ED²", panels))
}

/// Times and errors of every size, in the order of the sizes.
fn settings(trials: &Rows<'_>) -> Vec<Vec<(f64, f64)>> {
    // On a logarithmic axis there is no place for zero and below.
    let placed = |energy: f64| if energy <= 0.0 { f64::NAN } else { energy };
    let setting = |size: f64| {
        let pairs = trials.with("size", size).pairs(SECONDS, ENERGY).into_iter();
        pairs.map(|(seconds, energy)| (seconds, placed(energy))).collect()
    };
    trials.places("size").into_iter().map(setting).collect()
}
