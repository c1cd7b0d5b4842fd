//! One reduced run beside a full-order one.

use std::time::Instant;

use super::results::{FrameRow, ReducedRow};
use super::{ChoiceName, ExperimentError, ManifoldName, QuadratureName, SampleCount, UpdateName};
use crate::deformation_map::DeformationMap;
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::online::{Options, ReducedBody, ReducedModel, StepReport};
use crate::position_error::PositionError;
use crate::snapshots::Snapshots;

/// What a reduced run is made with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The family of maps.
    pub manifold: ManifoldName,
    /// |𝒫|.
    pub samples: SampleCount,
    /// How they are chosen.
    pub chosen: ChoiceName,
    /// Where the momentum balance is summed.
    pub quadrature: QuadratureName,
    /// How coordinates follow from velocities.
    pub update: UpdateName,
    /// Δt over that of the full-order run.
    pub step_factor: u64,
}

/// A full-order run to compare with.
pub(super) struct Full<const D: usize> {
    pub case: usize,
    /// Its only run.
    pub snapshots: Snapshots<D>,
    /// Its wall time.
    pub seconds: f64,
}

/// Runs as many frames as the full-order run has, or up to the first error. The first frame, where both start, has no part in the error.
/// The search for x̂₀ begins at `guess`.
pub(super) fn beside<const D: usize>(
    manifold: &dyn Manifold<D>,
    guess: &[f64],
    body: ReducedBody<D>,
    full: &Full<D>,
    choice: &Choice,
    options: Options,
) -> Result<(ReducedRow, Vec<FrameRow>), ExperimentError> {
    let map = DeformationMap::new(manifold, full.snapshots.reference(), guess)?;
    let mut reduced = ReducedModel::new(body, map, options)?;
    let points = reduced.prepare(full.snapshots.reference());
    let (mut total, mut evaluation) = (PositionError::default(), Evaluation::default());
    let (mut report, mut seconds, mut outcome) = (StepReport::default(), 0.0, "finished".to_owned());
    let mut rows = Vec::new();
    for frame in full.snapshots.runs().iter().flat_map(|run| &run.frames) {
        let mut error = PositionError::default();
        if !rows.is_empty() {
            let start = Instant::now();
            let advanced = reduced.advance_frame();
            seconds += start.elapsed().as_secs_f64();
            match advanced {
                Ok(done) => report = done,
                Err(error) => {
                    outcome = error.to_string();
                    break;
                }
            }
        }
        reduced.evaluate(&points, Wanted::default(), &mut evaluation);
        error.add(&evaluation.positions, &frame.positions);
        if !rows.is_empty() {
            total.merge(&error);
        }
        rows.push(FrameRow {
            time: reduced.time(),
            error: error.percent().unwrap_or(0.0),
            latent: reduced.latent().to_vec(),
        });
    }
    let steps = reduced.timings().steps;
    let frames: usize = full.snapshots.runs().iter().map(|run| run.frames.len()).sum();
    let all_steps = (frames as u64).saturating_sub(1) * reduced.body().steps_per_frame;
    let row = ReducedRow {
        case: full.case,
        parameters: full
            .snapshots
            .runs()
            .iter()
            .flat_map(|run| run.parameters.clone())
            .collect(),
        manifold: choice.manifold.name(),
        samples: reduced.samples().len(),
        chosen: match choice.samples {
            SampleCount::All(_) => "all",
            SampleCount::Drawn(_) => choice.chosen.name(),
        },
        quadrature: choice.quadrature.name(),
        update: choice.update.name(),
        step_factor: choice.step_factor,
        error: total.percent().unwrap_or(0.0),
        reconstruction_error: None,
        simulated: steps as f64 * reduced.body().time_step,
        steps,
        seconds,
        full_seconds: full.seconds * steps as f64 / all_steps.max(1) as f64,
        nodes: report.nodes,
        quadrature_points: report.quadrature_points,
        refreshes: report.refreshes,
        outcome,
    };
    Ok((row, rows))
}
