//! One reduced run beside a full-order one.

use std::time::Instant;

use super::comparison::Comparison;
use super::frame_files::FrameFiles;
use super::results::{FrameRow, ReducedRow};
use super::super_resolution::{Finer, SuperResolved};
use super::{ChoiceName, ExperimentError, ManifoldName, QuadratureName, SampleCount};
use crate::deformation_map::DeformationMap;
use crate::manifold::Manifold;
use crate::online::{Options, ReducedBody, ReducedModel, StepReport, Update};
use crate::snapshots::Frame;

/// What a reduced run is made with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The family of maps.
    pub manifold: ManifoldName,
    /// Which of the experiment's networks; 0 where it is none.
    pub network: usize,
    /// |𝒫|.
    pub samples: SampleCount,
    /// How they are chosen.
    pub chosen: ChoiceName,
    /// Where the momentum balance is summed.
    pub quadrature: QuadratureName,
    /// How coordinates follow from velocities.
    pub update: Update,
    /// Δt over that of the full-order run.
    pub step_factor: u64,
}

impl Choice {
    /// How its sample points are chosen, in a word: there is one way to take all of them.
    pub fn way(&self) -> &'static str {
        match self.samples {
            SampleCount::All => "all",
            SampleCount::Drawn(_) => self.chosen.name(),
        }
    }

    /// Whether its sample points are chosen on training runs.
    pub(super) fn is_made_on_training(&self) -> bool {
        self.samples.count().is_some() && self.chosen.needs_training()
    }
}

/// A full-order run to compare with.
pub(super) struct Full<'a, const D: usize> {
    pub case: usize,
    pub parameters: &'a [f64],
    /// X_p of its points, and its frames.
    pub reference: &'a [[f64; D]],
    pub frames: &'a [Frame<D>],
    /// Its wall time.
    pub seconds: f64,
    /// The run of the same case with more points.
    pub finer: Option<&'a Finer<D>>,
}

/// Runs to the times of all frames of the full-order run, or up to the first error. The first frame, where both start, has no part in the error.
/// The search for x̂₀ begins at `guess`; `files` takes the frames.
pub(super) fn beside<const D: usize>(
    manifold: &dyn Manifold<D>,
    guess: &[f64],
    body: ReducedBody<D>,
    full: &Full<'_, D>,
    choice: &Choice,
    options: Options,
    mut files: Option<FrameFiles>,
) -> Result<ReducedRow, ExperimentError> {
    let map = DeformationMap::new(manifold, full.reference, guess)?;
    let mut reduced = ReducedModel::new(body, map, options)?;
    let mut own = Comparison::new(&reduced, full.reference);
    let mut finer = full
        .finer
        .filter(|_| choice.manifold == ManifoldName::Network)
        .map(|finer| (Comparison::new(&reduced, finer.snapshots.reference()), finer));
    let (mut report, mut seconds, mut outcome) = (StepReport::default(), 0.0, "finished".to_owned());
    let mut rows = Vec::new();
    for (number, frame) in full.frames.iter().enumerate() {
        let first = number == 0;
        if !first {
            let start = Instant::now();
            let advanced = reduced.advance_to(frame.time);
            seconds += start.elapsed().as_secs_f64();
            match advanced {
                Ok(done) => report = done,
                Err(error) => {
                    outcome = error.to_string();
                    break;
                }
            }
        }
        rows.push(FrameRow {
            time: reduced.time(),
            error: own.add(&reduced, frame, first),
            latent: reduced.latent().to_vec(),
        });
        let (mut finest, mut expected) = (&own, frame);
        if let Some((comparison, finer)) = &mut finer
            && let Some(frame) = finer.snapshots.frames().nth(number)
        {
            comparison.add(&reduced, frame, first);
            (finest, expected) = (comparison, frame);
        }
        if let Some(files) = &mut files {
            let mut snapshot = reduced.snapshot(&finest.points);
            let errors = ("position_error".to_owned(), finest.distances(expected));
            snapshot.scalars.push(errors);
            files.write(&snapshot)?;
        }
    }
    let steps = reduced.steps();
    let end = full.frames.last().map_or(0.0, |frame| frame.time);
    let all_steps = (end / reduced.body().time_step).round();
    Ok(ReducedRow {
        samples: reduced.samples().len(),
        error: own.total.percent(),
        super_resolved: finer.map(|(comparison, finer)| SuperResolved {
            points: finer.snapshots.points(),
            error: comparison.total.percent(),
            tracer_error: finer.tracer_error,
        }),
        latent_return: latent_return(&rows),
        simulated: steps as f64 * reduced.body().time_step,
        steps,
        seconds,
        full_seconds: full.seconds * steps as f64 / all_steps.max(1.0),
        report,
        outcome,
        frames: rows,
        ..not_begun(full, choice, 0)
    })
}

/// The row of a run without any step, of a body of so many points.
pub(super) fn not_begun<const D: usize>(full: &Full<'_, D>, choice: &Choice, points: usize) -> ReducedRow {
    ReducedRow {
        case: full.case,
        parameters: full.parameters.to_vec(),
        choice: *choice,
        variant: String::new(),
        samples: choice.samples.count().unwrap_or(points),
        error: None,
        reconstruction_error: None,
        super_resolved: None,
        latent_return: 0.0,
        simulated: 0.0,
        steps: 0,
        seconds: 0.0,
        full_seconds: 0.0,
        report: StepReport::default(),
        outcome: String::new(),
        frames: Vec::new(),
    }
}

/// How far x̂ is from its start in the end, over its largest distance from there: 0 where the path is closed. A path that never leaves its start is.
fn latent_return(rows: &[FrameRow]) -> f64 {
    let distance = |row: &FrameRow| {
        let pairs = row.latent.iter().zip(&rows[0].latent);
        pairs.map(|(y, start)| (y - start).powi(2)).sum::<f64>().sqrt()
    };
    let largest = rows.iter().map(distance).fold(0.0, f64::max);
    match rows.last() {
        Some(last) if largest > 0.0 => distance(last) / largest,
        _ => 0.0,
    }
}
