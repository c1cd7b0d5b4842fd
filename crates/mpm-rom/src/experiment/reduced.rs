//! Reduced runs of the test cases, each beside its full-order run.

use std::path::Path;

use mpm_scenes::Scene;

use super::at_hand::{AtHand, WithoutPoints};
use super::beside::{Choice, Full, beside, not_begun};
use super::choices::choices;
use super::chosen::Chosen;
use super::error::unless_impossible;
use super::files::{self, names};
use super::frame_files::{self, FrameFiles};
use super::results::{self, ReducedRow};
use super::super_resolution::Finer;
use super::{Experiment, ExperimentError, ManifoldName};
use crate::full_order::{FullOrderError, Recording};
use crate::online::ReducedBody;
use crate::snapshots::{Run, Snapshots};

/// Runs every test case with the model of `directory`, and writes the tables there. `after_run` is told how many reduced runs are done, and of how many, also while sample points are still tried on training runs; a false ends
/// them.
///
/// The tables grow with every run.
///
/// A reduced run that fails is a row with its error, and the others go on.
///
/// # Errors
/// [`ExperimentError`]: no model, or one that does not fit; options that make no sense; a full-order run that fails.
pub fn run<const D: usize>(
    experiment: &Experiment,
    directory: &Path,
    after_run: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<Vec<ReducedRow>, ExperimentError> {
    files::made_by_training(directory.join(names::MODEL))?;
    // Not after minutes of choices on training runs.
    experiment.check_sample_counts::<D>()?;
    experiment.check_same_body::<D>()?;
    experiment.occupy(directory)?;
    experiment.check_scene_of(directory)?;
    let at_hand = AtHand::<D>::read(experiment, directory)?;
    let choices = choices(experiment, at_hand.models.len());
    let runs = choices.len() * experiment.cases.test.len();
    let (mut chosen, without_points) = at_hand.choose_points(&mut || after_run(0, runs))?;
    frame_files::forget_earlier(directory)?;
    let mut rows = Vec::new();
    for case in 0..experiment.cases.test.len() {
        let test_case = TestCase::run(&at_hand, case)?;
        for choice in &choices {
            rows.push(test_case.reduced(choice, rows.len(), &mut chosen, &without_points)?);
            let table = results::results(&experiment.parameters, &rows);
            files::write(&directory.join(names::RESULTS), &table)?;
            files::write(&directory.join(names::FRAMES), &results::frames(&rows))?;
            if !after_run(rows.len(), runs) {
                return Err(ExperimentError::Stopped);
            }
        }
    }
    Ok(rows)
}

/// The full-order run of a test case.
struct TestCase<'a, const D: usize> {
    at_hand: &'a AtHand<'a, D>,
    case: usize,
    scene: Scene,
    snapshots: Snapshots<D>,
    seconds: f64,
    finer: Option<Finer<D>>,
    /// By network; the encoder knows the points that it was trained on, no others.
    reconstruction_errors: Vec<Option<f64>>,
}

impl<'a, const D: usize> TestCase<'a, D> {
    fn run(at_hand: &'a AtHand<'a, D>, case: usize) -> Result<Self, ExperimentError> {
        let (experiment, values) = (at_hand.experiment, &at_hand.experiment.cases.test[case]);
        let centroid = &at_hand.trained_on.centroid;
        let scene = experiment.scene_of(&at_hand.document, values)?;
        // Full-order runs can be long: what makes no reduced body is refused before them.
        for &factor in &experiment.run.step_factor {
            reduced_body(experiment, &scene, centroid, factor)?;
        }
        let recording = Recording::<D>::of(&scene, &experiment.parameters, experiment.recorded_points)?;
        let recording = recording.about(centroid);
        let (frames, effort) = recording
            .run_in_even_steps(&scene)
            .map_err(|error| ExperimentError::of_test_case(experiment, case, error))?;
        let run = Run {
            parameters: values.clone(),
            frames,
        };
        let snapshots = Snapshots::new(recording.body, vec![run]).map_err(FullOrderError::from)?;
        let models = at_hand.models.iter();
        let reconstruction_errors = match &experiment.run.scene {
            None => models
                .map(|(_, model)| model.reconstruction_error(&snapshots).map(Some))
                .collect::<Result<_, _>>()?,
            Some(_) => vec![None; models.len()],
        };
        let finer = match &at_hand.finer {
            None => None,
            Some(finer) => {
                let coarse = reduced_body(experiment, &scene, centroid, 1)?;
                Some(Finer::run(experiment, finer, case, &coarse, &snapshots)?)
            }
        };
        Ok(Self {
            at_hand,
            case,
            scene,
            snapshots,
            seconds: effort.time.as_secs_f64(),
            finer,
            reconstruction_errors,
        })
    }

    /// The reduced run with a number, beside it.
    fn reduced(
        &self,
        choice: &Choice,
        number: usize,
        chosen: &mut Chosen<D>,
        without_points: &WithoutPoints,
    ) -> Result<ReducedRow, ExperimentError> {
        let AtHand {
            experiment, directory, ..
        } = *self.at_hand;
        let full = Full {
            case: self.case,
            parameters: &experiment.cases.test[self.case],
            reference: self.snapshots.reference(),
            frames: &self.snapshots.runs()[0].frames,
            seconds: self.seconds,
            finer: self.finer.as_ref(),
        };
        let manifold = self.at_hand.manifold(choice.manifold, choice.network);
        let centroid = &self.at_hand.trained_on.centroid;
        let body = reduced_body(experiment, &self.scene, centroid, choice.step_factor)?;
        let guess = match choice.manifold {
            ManifoldName::Network => self.at_hand.at_rest[choice.network].clone(),
            ManifoldName::Linear => vec![0.0; manifold.coordinates()],
        };
        let points = body.reference.len();
        let made = || {
            let run = &experiment.run;
            let samples = run.samples(choice, chosen, manifold.coordinates(), &body)?;
            let options = run.options(choice, samples);
            let written = run.vtu.then(|| FrameFiles::of_run(directory, number));
            beside(manifold, &guess, body, &full, choice, options, written.transpose()?)
        };
        let without_points = without_points.iter().find(|(name, network, _)| {
            choice.is_made_on_training() && (*name, *network) == (choice.manifold, choice.network)
        });
        let made = match without_points {
            Some((_, _, reason)) => Err(reason.clone()),
            None => unless_impossible(made())?,
        };
        let mut row = made.unwrap_or_else(|outcome| ReducedRow {
            outcome,
            ..not_begun(&full, choice, points)
        });
        if choice.manifold == ManifoldName::Network {
            row.reconstruction_error = self.reconstruction_errors[choice.network];
            row.variant = self.at_hand.models[choice.network].0.clone();
        }
        Ok(row)
    }
}

/// The body of a scene about the origin of the training, with time steps so many times as long.
fn reduced_body<const D: usize>(
    experiment: &Experiment,
    scene: &Scene,
    centroid: &[f64; D],
    step_factor: u64,
) -> Result<ReducedBody<D>, ExperimentError> {
    let body = ReducedBody::of(scene)?.about(centroid);
    let steps = body.steps_per_frame;
    let longer = body.with_longer_steps(step_factor);
    longer.ok_or_else(|| uneven(experiment, step_factor, steps))
}

/// Refuses time steps that do not divide a frame of so many.
pub(super) fn check_step_factor(experiment: &Experiment, factor: u64, steps: u64) -> Result<(), ExperimentError> {
    let divides = factor > 0 && steps.is_multiple_of(factor);
    divides.then_some(()).ok_or_else(|| uneven(experiment, factor, steps))
}

fn uneven(experiment: &Experiment, factor: u64, steps: u64) -> ExperimentError {
    let message = format!("{factor} does not divide the number of steps of a frame, {steps}");
    experiment.field("run.step_factor", message)
}
