//! The figure of the study `time-to-equal-error`: squared energy distance against wall time, a panel per target.

use super::TimeToEqualError;
use crate::plots::{TimeErrorCurve, TimeErrorPanel, time_error};
use crate::study::prelude::*;

/// The method with a point per M; chains and independent draws with a point per number of draws; other rivals with a curve for every
/// M, a point per number of steps.
pub fn plot(
    study: &TimeToEqualError,
    rows: &Rows<'_>,
    directory: &StudyDirectory,
) -> Result<MultiplesPlot, CommandError> {
    // The cases are in the order of the targets.
    let mut panels: Vec<TimeErrorPanel> = Vec::new();
    for Case { row, work: case, .. } in study.cases()? {
        if rows.with("case", row.case()).is_empty() {
            continue;
        }
        let trials = case.trials(directory, super::COLUMNS)?;
        let settings = settings(&trials.iter().collect());
        if settings.is_empty() {
            continue;
        }
        let target = case.target.label();
        if panels.last().is_none_or(|panel| panel.target != target) {
            panels.push(TimeErrorPanel {
                target,
                ..TimeErrorPanel::default()
            });
        }
        let curves = panels.last_mut().map(|panel| &mut panel.curves);
        let Some(curves) = curves else { continue };
        let one_curve = case.index == 0 || !case.method.name.iterates();
        let method = match one_curve || study.particles.len() == 1 {
            true => case.method.label().to_owned(),
            false => format!("{}, M = {}", case.method.label(), case.particles),
        };
        match curves.iter_mut().find(|curve| curve.method == method) {
            // The runs of a chain for the larger M begin with those for the smaller one.
            Some(curve) if case.index > 0 && settings.len() > curve.settings.len() => curve.settings = settings,
            Some(curve) if case.index == 0 => curve.settings.extend(settings),
            Some(_) => {}
            None => curves.push(TimeErrorCurve { method, settings }),
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
