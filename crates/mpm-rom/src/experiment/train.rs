//! From full-order data to models.

use std::path::Path;
use std::time::Instant;

use super::files::{self, names};
use super::starts::best_start;
use super::trained::{Trained, Watch, train_network};
use super::variants::directory_of;
use super::{Experiment, ExperimentError};
use crate::full_order::{self, FullOrderError, Kept};
use crate::snapshots::Snapshots;
use crate::words::in_number;

/// Runs the scene for all training cases, trains the network and its variants, and writes the models. What the directory holds of it already is not done again.
///
/// # Errors
/// [`ExperimentError`]; [`ExperimentError::Stopped`] where the watch broke.
pub fn train<const D: usize>(
    experiment: &Experiment,
    directory: &Path,
    watch: &mut dyn Watch,
) -> Result<Vec<Trained>, ExperimentError> {
    experiment.check_sample_counts::<D>()?;
    experiment.check_reducible::<D>()?;
    experiment.check_same_body::<D>()?;
    experiment.occupy(directory)?;
    experiment.check_scene_of(directory)?;
    let start = Instant::now();
    let snapshots = training_data::<D>(experiment, directory, watch)?;
    let data_time = start.elapsed();
    let networks = experiment.trainings()?.into_iter();
    networks
        .map(|(name, training)| {
            let directory = directory_of(directory, name);
            files::create(&directory)?;
            let trained = match experiment.starts {
                1 => train_network(&snapshots, &training, &directory, watch)?,
                _ => best_start(experiment, &snapshots, &training, &directory, watch)?,
            };
            Ok(Trained {
                name: name.to_owned(),
                data_time,
                ..trained
            })
        })
        .collect()
}

/// The snapshots of the training runs, from the directory or from the scene.
fn training_data<const D: usize>(
    experiment: &Experiment,
    directory: &Path,
    watch: &mut dyn Watch,
) -> Result<Snapshots<D>, ExperimentError> {
    let file = directory.join(names::TRAINING_DATA);
    if file.exists() {
        return experiment.read_data(directory);
    }
    let document = experiment.read_scene()?;
    let values = &experiment.cases.train;
    let cases: Vec<_> = values
        .iter()
        .map(|values| experiment.case(values))
        .collect::<Result<_, _>>()?;
    let after_run = |done| watch.after_run(done, values.len());
    let kept = Kept {
        points: experiment.recorded_points,
        between: experiment.frames_between,
    };
    let snapshots = match full_order::collect(&document, &experiment.parameters, &cases, &kept, after_run) {
        Err(FullOrderError::Stopped { .. }) => return Err(ExperimentError::Stopped),
        collected => collected.map_err(|error| experiment.blamed(error))?,
    };
    // What these runs were made of.
    files::write(&directory.join(names::SCENE), document.text())?;
    snapshots.write(&file)?;
    Ok(snapshots)
}

impl Experiment {
    /// The snapshots of the training runs in a directory.
    ///
    /// # Errors
    /// [`ExperimentError::Untrained`] without them; [`ExperimentError::TensorFile`]; [`ExperimentError::OtherData`] for those of another scene or of other cases.
    pub(super) fn read_data<const D: usize>(&self, directory: &Path) -> Result<Snapshots<D>, ExperimentError> {
        let file = files::made_by_training(directory.join(names::TRAINING_DATA))?;
        let snapshots = Snapshots::<D>::read(&file)?;
        let (body, runs) = (snapshots.body(), snapshots.runs());
        let title = self.scene_of(&self.read_scene()?, &self.cases.train[0])?.title;
        let cases = || runs.iter().map(|run| &run.parameters);
        let differs = (0..)
            .zip(cases().zip(&self.cases.train))
            .find(|(_, (found, expected))| found != expected);
        let pairs = [
            Some((format!("scene `{}`", body.scene), format!("scene `{title}`"))),
            Some((
                format!("parameters {:?}", body.parameters),
                format!("parameters {:?}", self.parameters),
            )),
            Some((in_number(runs.len(), "run"), in_number(self.cases.train.len(), "run"))),
            differs.map(|(run, (found, expected))| (format!("run {run} of {found:?}"), format!("{expected:?}"))),
        ];
        match pairs.into_iter().flatten().find(|(found, expected)| found != expected) {
            None => Ok(snapshots),
            Some((found, expected)) => Err(ExperimentError::OtherData {
                file: file.display().to_string(),
                found,
                expected,
            }),
        }
    }
}
