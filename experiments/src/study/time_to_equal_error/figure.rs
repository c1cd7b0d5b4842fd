//! The figure of the study `time-to-equal-error`: squared energy distance against wall time, a panel per target.

use super::row::Row;
use super::search::Trial;
use super::{Case, TimeToEqualError};
use crate::CommandError;
use crate::options::TargetSpecification;
use crate::output::table_file;
use crate::plots::{TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint};
use crate::study::definition::{self, Study};
use crate::study::directory::StudyDirectory;

/// The method with a point per M; chains and independent draws with a point per number of draws; other rivals with a curve for every
/// M, a point per number of steps.
pub fn plot(study: &TimeToEqualError, rows: &[Row], directory: &StudyDirectory) -> Result<TimeErrorPlot, CommandError> {
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
    Ok(TimeErrorPlot {
        x_label: "wall time (s)".to_owned(),
        y_label: "ED²".to_owned(),
        panels,
        ..TimeErrorPlot::default()
    })
}

fn curves(
    study: &TimeToEqualError,
    rows: &[Row],
    target: &TargetSpecification,
    directory: &StudyDirectory,
) -> Result<Vec<TimeErrorCurve>, CommandError> {
    let cases: Vec<Case> = study
        .cases()?
        .into_iter()
        .filter(|case| case.target == *target)
        .filter(|case| rows.iter().any(|row| row.case == definition::Case::id(case)))
        .collect();
    let mut curves: Vec<TimeErrorCurve> = Vec::new();
    for case in &cases {
        let trials: Vec<Trial> = table_file::read(&case.trials_file(directory))?;
        let points = points(&trials);
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
