//! Reduced runs of the test cases, each beside its full-order run.

use std::path::Path;

use super::beside::{Choice, Full, beside};
use super::files::{self, names};
use super::results::{self, ReducedRow};
use super::trained::model_for;
use super::{Experiment, ExperimentError, ManifoldName};
use crate::full_order::{FullOrderError, Recording, SceneDocument};
use crate::manifold::{Manifold, Pod};
use crate::online::ReducedBody;
use crate::snapshots::{Run, Snapshots};

/// Runs every test case with the model of `directory`, and writes the tables there. `after_run` is told how many reduced runs are done, and of how many; a false ends them.
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
    experiment.occupy(directory)?;
    let document = SceneDocument::read(&experiment.run_scene_file())?;
    let (model, trained_on) = model_for::<D>(experiment, directory)?;
    let rest = model.encoder().encode(&trained_on.reference)?;
    let linear = linear::<D>(experiment, directory, model.network().coordinates())?;
    let (choices, mut rows, mut frames) = (choices(experiment), Vec::new(), Vec::new());
    let runs = choices.len() * experiment.cases.test.len();
    for (case, values) in experiment.cases.test.iter().enumerate() {
        let scene = document.scene(&experiment.case(values)?.changes)?;
        let recording = Recording::<D>::of(&scene, &experiment.parameters, experiment.recorded_points)?;
        let recording = recording.about(&trained_on.centroid);
        let (frames_of_run, effort) = recording.run(&scene)?;
        let run = Run {
            parameters: values.clone(),
            frames: frames_of_run,
        };
        let snapshots = Snapshots::new(recording.body, vec![run]).map_err(FullOrderError::from)?;
        // The encoder knows the points that it was trained on, no others.
        let reconstruction_error = match &experiment.run.scene {
            None => Some(model.reconstruction_error(&snapshots)?),
            Some(_) => None,
        };
        let full = Full {
            case,
            snapshots,
            seconds: effort.time.as_secs_f64(),
        };
        for choice in &choices {
            let network = (model.network() as &dyn Manifold<D>, reconstruction_error);
            let (manifold, reconstruction_error) = match (choice.manifold, &linear) {
                (ManifoldName::Linear, Some(pod)) => (pod as &dyn Manifold<D>, None),
                _ => network,
            };
            let body = ReducedBody::of(&scene)?.about(&trained_on.centroid);
            let guess = match choice.manifold {
                ManifoldName::Network => rest.clone(),
                ManifoldName::Linear => vec![0.0; manifold.coordinates()],
            };
            let options = experiment.run.options(choice);
            let (mut row, of_run) = beside(manifold, &guess, body, &full, choice, options)?;
            row.reconstruction_error = reconstruction_error;
            frames.push(of_run);
            rows.push(row);
            let table = results::results(&experiment.parameters, &rows);
            files::write(&directory.join(names::RESULTS), &table)?;
            files::write(&directory.join(names::FRAMES), &results::frames(&frames))?;
            if !after_run(rows.len(), runs) {
                return Err(ExperimentError::Stopped);
            }
        }
    }
    Ok(rows)
}

/// All combinations of what is asked for.
fn choices(experiment: &Experiment) -> Vec<Choice> {
    let mut all = Vec::new();
    for &manifold in &experiment.run.manifold {
        for &samples in &experiment.run.samples {
            for &quadrature in &experiment.run.quadrature {
                for &update in &experiment.run.update {
                    all.push(Choice {
                        manifold,
                        samples,
                        quadrature,
                        update,
                    });
                }
            }
        }
    }
    all
}

/// The linear manifold of the training data, known at the material points, where it is asked for.
fn linear<const D: usize>(
    experiment: &Experiment,
    directory: &Path,
    coordinates: usize,
) -> Result<Option<Pod<D>>, ExperimentError> {
    if !experiment.run.manifold.contains(&ManifoldName::Linear) {
        return Ok(None);
    }
    let snapshots = Snapshots::read(&directory.join(names::TRAINING_DATA))?;
    Ok(Some(Pod::new(&snapshots, coordinates)?))
}
