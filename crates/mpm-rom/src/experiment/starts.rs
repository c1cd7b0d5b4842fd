//! The best of several networks that differ in their seed.

use std::cell::RefCell;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use mpm_scenes::output::write_whole;

use super::files::{self, START, names};
use super::sampling::Sampling;
use super::trained::{Start, Trained, Watch, train_network};
use super::{Experiment, ExperimentError, ManifoldName};
use crate::model::Model;
use crate::snapshots::Snapshots;
use crate::training::Training;

/// Trains a network from each of several seeds, each in a directory of its own, and keeps the one whose reduced runs of training cases are nearest to their full-order runs; of
/// equals that with the smaller gradient error.
///
/// Networks that lose as little of the training data may differ by half and more in the runs that they make: a loss does not tell what forces are wrong together.
pub(super) fn best_start<const D: usize>(
    experiment: &Experiment,
    snapshots: &Snapshots<D>,
    training: &Training,
    directory: &Path,
    watch: &mut dyn Watch,
) -> Result<Trained, ExperimentError> {
    let document = experiment.read_scene()?;
    let (mut starts, mut training_time) = (Vec::new(), Duration::ZERO);
    let watch = RefCell::new(watch);
    let mut best: Option<(Start, PathBuf, Trained)> = None;
    for number in 0..experiment.starts {
        let place = directory.join(format!("{START}{number}"));
        files::create(&place)?;
        let training = Training {
            seed: training.seed.wrapping_add(number),
            ..training.clone()
        };
        let trained = train_network(snapshots, &training, &place, &mut **watch.borrow_mut())?;
        training_time += trained.training_time;
        let model = Model::read(&place.join(names::MODEL))?;
        let sampling = Sampling {
            experiment,
            document: &document,
            model: &model,
            network: 0,
            name: ManifoldName::Network,
            manifold: model.network(),
            snapshots,
            go_on: &|| watch.borrow_mut().after_trial().is_continue(),
        };
        let position_error = match sampling.error_of_training_runs() {
            // A network without a state at rest, or without a step, makes no run.
            Err(ExperimentError::Map(_) | ExperimentError::Online(_)) => f64::INFINITY,
            other => other?,
        };
        let start = Start {
            seed: training.seed,
            reconstruction_error: trained.reconstruction_error,
            gradient_error: trained.gradient_error,
            position_error,
        };
        starts.push(start);
        files::write(&directory.join(names::STARTS), &table(&starts))?;
        if best.as_ref().is_none_or(|(best, ..)| start.is_better_than(best)) {
            best = Some((start, place, trained));
        }
    }
    let (_, place, best) = best.ok_or_else(|| experiment.field("starts", "0: at least 1"))?;
    for name in [names::MODEL, names::LOSSES] {
        let from = place.join(name);
        let bytes = fs::read(&from).map_err(|source| ExperimentError::file("read", &from, source))?;
        write_whole(&directory.join(name), &bytes)?;
    }
    Ok(Trained {
        starts,
        training_time,
        ..best
    })
}

impl Start {
    fn is_better_than(&self, other: &Self) -> bool {
        let key = |start: &Self| (start.position_error, start.gradient_error);
        key(self) < key(other)
    }
}

/// One row per start.
fn table(starts: &[Start]) -> String {
    let mut text = "seed,reconstruction_error_percent,gradient_error,position_error_percent\n".to_owned();
    for start in starts {
        text += &format!(
            "{},{},{},{}\n",
            start.seed, start.reconstruction_error, start.gradient_error, start.position_error
        );
    }
    text
}
