//! Reduced runs of the test cases, each beside its full-order run.

use std::path::Path;
use std::time::Instant;

use super::files::{self, names};
use super::results::{self, FrameRow, ReducedRow};
use super::trained::model_for;
use super::{Experiment, ExperimentError, QuadratureName, SampleCount, UpdateName};
use crate::deformation_map::DeformationMap;
use crate::full_order::{self, FullOrderError, SceneDocument};
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::model::Model;
use crate::online::{OnlineError, ReducedBody, ReducedModel, StepReport};
use crate::position_error::PositionError;
use crate::snapshots::{Run, Snapshots};

/// A full-order run to compare with.
struct Full<const D: usize> {
    case: usize,
    /// Its only run.
    snapshots: Snapshots<D>,
    seconds: f64,
    reconstruction_error: f64,
}

/// Runs every test case with the model of `directory`, and writes the tables there. `after_case` is told the number of cases done; a false ends the runs.
///
/// A reduced run that fails is a row with its error, and the others go on.
///
/// # Errors
/// [`ExperimentError`]: no model, or one that does not fit; a full-order run that fails.
pub fn run<const D: usize>(
    experiment: &Experiment,
    directory: &Path,
    after_case: &mut dyn FnMut(usize) -> bool,
) -> Result<Vec<ReducedRow>, ExperimentError> {
    experiment.occupy(directory)?;
    let document = SceneDocument::read(&experiment.scene_file())?;
    let (mut rows, mut frames) = (Vec::new(), Vec::new());
    for (case, values) in experiment.cases.test.iter().enumerate() {
        let scene = document.scene(&experiment.case(values)?.changes)?;
        let body = full_order::body_of::<D>(&scene, &experiment.parameters)?;
        let model = model_for::<D>(directory, &scene.title, body.reference.len())?;
        let start = Instant::now();
        let run = Run {
            parameters: values.clone(),
            frames: full_order::run(&scene, &body.centroid)?,
        };
        let seconds = start.elapsed().as_secs_f64();
        let snapshots = Snapshots::new(body, vec![run]).map_err(FullOrderError::from)?;
        let full = Full {
            case,
            reconstruction_error: model.reconstruction_error(&snapshots)?,
            snapshots,
            seconds,
        };
        for &samples in &experiment.run.samples {
            for &quadrature in &experiment.run.quadrature {
                for &update in &experiment.run.update {
                    let choice = (samples, quadrature, update);
                    let body = ReducedBody::of(&scene)?;
                    let row = beside(experiment, &model, body, &full, choice, rows.len(), &mut frames)?;
                    rows.push(row);
                }
            }
        }
        files::write(
            &directory.join(names::RESULTS),
            &results::results(&experiment.parameters, &rows),
        )?;
        files::write(&directory.join(names::FRAMES), &results::frames(&frames))?;
        if !after_case(case + 1) {
            return Err(ExperimentError::Stopped);
        }
    }
    Ok(rows)
}

/// One reduced run; its frames are appended.
fn beside<const D: usize>(
    experiment: &Experiment,
    model: &Model<D>,
    body: ReducedBody<D>,
    full: &Full<D>,
    (samples, quadrature, update): (SampleCount, QuadratureName, UpdateName),
    run: usize,
    rows: &mut Vec<FrameRow>,
) -> Result<ReducedRow, ExperimentError> {
    let start = model.encoder().encode(&body.reference)?;
    let interval = body.time_step * body.steps_per_frame as f64;
    let map = DeformationMap::new(model.network().clone(), &body.reference, &start)?;
    let mut reduced = ReducedModel::new(body, map, experiment.run.options(samples, quadrature, update))?;
    let (mut total, mut evaluation, mut report) =
        (PositionError::default(), Evaluation::default(), StepReport::default());
    let (mut seconds, mut outcome) = (0.0, "finished".to_owned());
    let full_run = &full.snapshots.runs()[0];
    for (number, frame) in full_run.frames.iter().enumerate() {
        if number > 0 {
            match timed(&mut reduced, &mut seconds) {
                Ok(done) => report = done,
                Err(error) => {
                    outcome = error.to_string();
                    break;
                }
            }
        }
        reduced.evaluate(reduced.points(), Wanted::default(), &mut evaluation);
        let mut error = PositionError::default();
        error.add(&evaluation.positions, &frame.positions);
        if number > 0 {
            total.merge(&error); // the first frame is where both start
        }
        rows.push(FrameRow {
            run,
            time: reduced.time(),
            error: error.percent().unwrap_or(0.0),
            latent: reduced.latent().to_vec(),
        });
    }
    let steps = reduced.timings().steps;
    let all_steps = (full_run.frames.len() as u64 - 1) * reduced.body().steps_per_frame;
    Ok(ReducedRow {
        case: full.case,
        parameters: full_run.parameters.clone(),
        samples: reduced.samples().len(),
        quadrature: quadrature.name(),
        update: update.name(),
        error: total.percent().unwrap_or(0.0),
        reconstruction_error: full.reconstruction_error,
        simulated: steps as f64 * interval / reduced.body().steps_per_frame as f64,
        steps,
        seconds,
        full_seconds: full.seconds * steps as f64 / all_steps.max(1) as f64,
        nodes: report.nodes,
        quadrature_points: report.quadrature_points,
        refreshes: report.refreshes,
        outcome,
    })
}

/// The next frame; its wall time is added.
fn timed<const D: usize, M: Manifold<D>>(
    reduced: &mut ReducedModel<D, M>,
    seconds: &mut f64,
) -> Result<StepReport, OnlineError> {
    let start = Instant::now();
    let report = reduced.advance_frame();
    *seconds += start.elapsed().as_secs_f64();
    report
}
