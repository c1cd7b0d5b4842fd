//! An experiment in the dimension of its scene: compiled here, once for all programs.

use std::path::Path;

use super::{Experiment, ExperimentError, ReducedRow, Trained, Watch, run, train};

/// [`train`] in the dimension of the experiment's scene.
///
/// # Errors
/// As [`train`]; [`ExperimentError::Dimension`] of a scene that has neither two nor three.
pub fn train_experiment(
    experiment: &Experiment,
    directory: &Path,
    watch: &mut dyn Watch,
) -> Result<Vec<Trained>, ExperimentError> {
    match dimension(experiment)? {
        2 => train::<2>(experiment, directory, watch),
        3 => train::<3>(experiment, directory, watch),
        dimension => Err(ExperimentError::Dimension { dimension }),
    }
}

/// [`run`] in the dimension of the experiment's scene.
///
/// # Errors
/// As [`run`]; [`ExperimentError::Dimension`] of a scene that has neither two nor three.
pub fn run_experiment(
    experiment: &Experiment,
    directory: &Path,
    after_run: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<Vec<ReducedRow>, ExperimentError> {
    match dimension(experiment)? {
        2 => run::<2>(experiment, directory, after_run),
        3 => run::<3>(experiment, directory, after_run),
        dimension => Err(ExperimentError::Dimension { dimension }),
    }
}

fn dimension(experiment: &Experiment) -> Result<usize, ExperimentError> {
    let document = experiment.read_scene()?;
    Ok(experiment.scene_of(&document, &experiment.cases.train[0])?.dimension)
}
