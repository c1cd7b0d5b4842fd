//! Reduced runs of the test cases, each beside its full-order run.

use std::cell::RefCell;
use std::path::Path;

use mpm_scenes::Scene;

use super::beside::{Choice, Full, beside, not_begun};
use super::chosen::Chosen;
use super::files::{self, names};
use super::frame_files::{self, FrameFiles};
use super::results::{self, ReducedRow};
use super::sampling::Sampling;
use super::super_resolution::Finer;
use super::trained::models_for;
use super::{Experiment, ExperimentError, ManifoldName, SampleCount};
use crate::full_order::{FullOrderError, Recording};
use crate::manifold::{Manifold, Pod};
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
    let model = directory.join(names::MODEL);
    if !model.exists() {
        return Err(ExperimentError::Untrained {
            model: model.display().to_string(),
        });
    }
    // Not after minutes of choices on training runs.
    experiment.check_sample_counts::<D>()?;
    experiment.check_same_body::<D>()?;
    experiment.occupy(directory)?;
    experiment.check_scene_of(directory)?;
    let document = experiment.read_run_scene()?;
    let finer = experiment.super_resolution_file();
    let finer = finer.map(|file| experiment.read_named("run.super_resolution", &file));
    let finer = finer.transpose()?;
    let (models, trained_on) = models_for::<D>(experiment, directory)?;
    let at_rest = models
        .iter()
        .map(|(_, model)| model.encoder().encode(&trained_on.reference));
    let at_rest: Vec<Vec<f64>> = at_rest.collect::<Result<_, _>>()?;
    // Linear manifolds and choices of sample points are made of the training data.
    let is_needed = experiment.run.manifold.contains(&ManifoldName::Linear) || experiment.run.chooses_on_training();
    let training: Option<Snapshots<D>> = is_needed.then(|| experiment.read_data(directory)).transpose()?;
    if let Some(snapshots) = &training
        && snapshots.points() != trained_on.reference.len()
    {
        return Err(ExperimentError::OtherData {
            file: directory.join(names::TRAINING_DATA).display().to_string(),
            found: format!("{} points", snapshots.points()),
            expected: format!("{} points", trained_on.reference.len()),
        });
    }
    let linear = match &training {
        Some(snapshots) if experiment.run.manifold.contains(&ManifoldName::Linear) => {
            let refused = |error| experiment.field("run.manifold", format!("\"linear\": {error}"));
            Some(Pod::new(snapshots, experiment.training.coordinates).map_err(refused)?)
        }
        _ => None,
    };
    let family = |name, network: usize| match (name, &linear) {
        (ManifoldName::Linear, Some(pod)) => pod as &dyn Manifold<D>,
        _ => models[network].1.network(),
    };
    let choices = choices(experiment, models.len());
    let runs = choices.len() * experiment.cases.test.len();
    let after_run = RefCell::new(after_run);
    let (mut chosen, mut without_points) = (Chosen::default(), Vec::new());
    if let Some(snapshots) = training.as_ref().filter(|_| experiment.run.chooses_on_training()) {
        let document = experiment.read_scene()?;
        for (name, network) in maps(experiment, models.len()) {
            let sampling = Sampling {
                experiment,
                document: &document,
                model: &models[network].1,
                network,
                name,
                manifold: family(name, network),
                snapshots,
                go_on: &|| after_run.borrow_mut()(0, runs),
            };
            if let Err(reason) = unless_impossible(sampling.choose(&mut chosen))? {
                without_points.push((name, network, reason));
            }
        }
    }
    frame_files::forget_earlier(directory)?;
    let after_run = after_run.into_inner();
    let mut rows = Vec::new();
    for (case, values) in experiment.cases.test.iter().enumerate() {
        let scene = experiment.scene_of(&document, values)?;
        // Full-order runs can be long: what makes no reduced body is refused before them.
        for &factor in &experiment.run.step_factor {
            reduced_body(experiment, &scene, &trained_on.centroid, factor)?;
        }
        let recording = Recording::<D>::of(&scene, &experiment.parameters, experiment.recorded_points)?;
        let recording = recording.about(&trained_on.centroid);
        let (frames_of_run, effort) = recording
            .run_in_even_steps(&scene)
            .map_err(|error| ExperimentError::of_test_case(experiment, case, error))?;
        let run = Run {
            parameters: values.clone(),
            frames: frames_of_run,
        };
        let snapshots = Snapshots::new(recording.body, vec![run]).map_err(FullOrderError::from)?;
        // The encoder knows the points that it was trained on, no others.
        let reconstruction_errors: Vec<Option<f64>> = match &experiment.run.scene {
            None => models
                .iter()
                .map(|(_, model)| model.reconstruction_error(&snapshots).map(Some))
                .collect::<Result<_, _>>()?,
            Some(_) => vec![None; models.len()],
        };
        let finer = match &finer {
            None => None,
            Some(finer) => {
                let coarse = reduced_body(experiment, &scene, &trained_on.centroid, 1)?;
                Some(Finer::run(experiment, finer, case, &coarse, &snapshots)?)
            }
        };
        let full = Full {
            case,
            parameters: values,
            reference: snapshots.reference(),
            frames: &snapshots.runs()[0].frames,
            seconds: effort.time.as_secs_f64(),
            finer: finer.as_ref(),
        };
        for choice in &choices {
            let manifold = family(choice.manifold, choice.network);
            let body = reduced_body(experiment, &scene, &trained_on.centroid, choice.step_factor)?;
            let guess = match choice.manifold {
                ManifoldName::Network => at_rest[choice.network].clone(),
                ManifoldName::Linear => vec![0.0; manifold.coordinates()],
            };
            let (number, points) = (rows.len(), body.reference.len());
            let made = || {
                let run = &experiment.run;
                let samples = run.samples(choice, &mut chosen, manifold.coordinates(), &body)?;
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
                row.reconstruction_error = reconstruction_errors[choice.network];
                row.variant = models[choice.network].0.clone();
            }
            rows.push(row);
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

/// A map without a state at rest, or one from which there is no step, is a result; other errors are none.
fn unless_impossible<T>(made: Result<T, ExperimentError>) -> Result<Result<T, String>, ExperimentError> {
    match made {
        Err(error @ (ExperimentError::Map(_) | ExperimentError::Online(_))) => Ok(Err(error.to_string())),
        made => made.map(Ok),
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

/// The families of maps with the numbers of their networks.
fn maps(experiment: &Experiment, networks: usize) -> Vec<(ManifoldName, usize)> {
    let names = experiment.run.manifold.iter();
    let each = names.flat_map(|&name| {
        let count = if name == ManifoldName::Network { networks } else { 1 };
        (0..count).map(move |network| (name, network))
    });
    each.collect()
}

/// All combinations of what is asked for.
fn choices(experiment: &Experiment, networks: usize) -> Vec<Choice> {
    let (run, mut all) = (&experiment.run, Vec::new());
    for (manifold, network) in maps(experiment, networks) {
        for &samples in &run.samples {
            for &quadrature in &run.quadrature {
                for &update in &run.update {
                    for &step_factor in &run.step_factor {
                        // There is one way to take all points.
                        let ways = match samples {
                            SampleCount::All => &run.choice[..1],
                            SampleCount::Drawn(_) => &run.choice,
                        };
                        all.extend(ways.iter().map(|&chosen| Choice {
                            manifold,
                            network,
                            samples,
                            chosen,
                            quadrature,
                            update,
                            step_factor,
                        }));
                    }
                }
            }
        }
    }
    all
}
