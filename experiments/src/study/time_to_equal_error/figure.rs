//! The figure of the study `time-to-equal-error`: squared energy distance against wall time, a panel per target.

use super::TimeToEqualError;
use super::search::Trial;
use crate::plots::{TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint};
use crate::study::prelude::*;

/// The method with a point per M; chains and independent draws with a point per number of draws; other rivals with a curve for every
/// M, a point per number of steps.
pub fn plot(
    study: &TimeToEqualError,
    rows: &Rows<'_>,
    directory: &StudyDirectory,
) -> Result<TimeErrorPlot, CommandError> {
    let mut panels = Vec::new();
    for target in &study.targets {
        let curves = curves(study, rows, target, directory)?;
        if !curves.is_empty() {
            panels.push(TimeErrorPanel {
                target: target.label(),
                curves,
                iid_level: None,
            });
        }
    }
    Ok(TimeErrorPlot::new("wall time (s)", "ED²", panels))
}

fn curves(
    study: &TimeToEqualError,
    rows: &Rows<'_>,
    target: &TargetSpecification,
    directory: &StudyDirectory,
) -> Result<Vec<TimeErrorCurve>, CommandError> {
    let mut curves: Vec<TimeErrorCurve> = Vec::new();
    for Case { row, work: case, .. } in study.cases()? {
        if case.target != *target || rows.with("case", row.case()).is_empty() {
            continue;
        }
        let points = points(&case.trials(directory)?);
        if points.is_empty() {
            continue;
        }
        let one_curve = case.index == 0 || !case.method.name.iterates();
        let method = match one_curve || study.particles.len() == 1 {
            true => case.method.label().to_owned(),
            false => format!("{}, M = {}", case.method.label(), case.particles),
        };
        match curves.iter_mut().find(|curve| curve.method == method) {
            // The runs of a chain for the larger M begin with those for the smaller one.
            Some(curve) if case.index > 0 && points.len() > curve.points.len() => curve.points = points,
            Some(curve) if case.index == 0 => curve.points.extend(points),
            Some(_) => {}
            None => curves.push(TimeErrorCurve { method, points }),
        }
    }
    Ok(curves)
}

/// A point per size, in the order of the sizes.
fn points(trials: &[Trial]) -> Vec<TimeErrorPoint> {
    let mut sizes: Vec<usize> = trials.iter().map(|trial| trial.size).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let point = |size: usize| {
        let here = || trials.iter().filter(move |trial| trial.size == size);
        // On a logarithmic axis there is no place for zero and below.
        let positive = |trial: &Trial| trial.energy_distance_squared.filter(|energy| *energy > 0.0);
        TimeErrorPoint {
            cost: here().map(|trial| trial.wall_seconds).collect(),
            error: here().map(|trial| positive(trial).unwrap_or(f64::NAN)).collect(),
        }
    };
    sizes.into_iter().map(point).collect()
}
