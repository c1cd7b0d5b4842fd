//! The best of several networks that differ in their seed.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use super::files::{self, names};
use super::sampling::Sampling;
use super::trained::{Start, Trained, Watch, train_network};
use super::{Experiment, ExperimentError};
use crate::full_order::SceneDocument;
use crate::model::Model;
use crate::snapshots::Snapshots;
use crate::training::Training;

/// Trains a network from each of several seeds, each in a directory of its own, and keeps the one whose reduced runs of training cases are nearest to their full-order runs; of
/// equals that with the smaller gradient error.
///
/// Networks that lose as little of the training data may differ by a factor of two and more in the runs that they make: a loss does not tell what forces are wrong together.
pub(super) fn best_start<const D: usize>(
    experiment: &Experiment,
    snapshots: &Snapshots<D>,
    training: &Training,
    directory: &Path,
    watch: &mut dyn Watch,
) -> Result<Trained, ExperimentError> {
    let document = SceneDocument::read(&experiment.scene_file())?;
    let mut all: Vec<(PathBuf, Trained)> = Vec::new();
    for number in 0..experiment.starts {
        let place = directory.join(directory_name(number));
        fs::create_dir_all(&place).map_err(|source| ExperimentError::file("create", &place, source))?;
        let training = Training {
            seed: training.seed.wrapping_add(number),
            ..training.clone()
        };
        let mut trained = train_network(snapshots, &training, &place, watch)?;
        let model = Model::read(&place.join(names::MODEL))?;
        let sampling = Sampling {
            experiment,
            document: &document,
            model: &model,
            network: 0,
            snapshots,
        };
        trained.starts = vec![Start {
            seed: training.seed,
            reconstruction_error: trained.reconstruction_error,
            gradient_error: trained.gradient_error,
            position_error: sampling.error_of_training_runs()?,
        }];
        all.push((place, trained));
        files::write(&directory.join(names::STARTS), &table(&all))?;
    }
    let starts: Vec<Start> = all.iter().flat_map(|(_, trained)| trained.starts.clone()).collect();
    let key = |(_, trained): &(PathBuf, Trained)| {
        trained.starts.first().map_or((f64::INFINITY, f64::INFINITY), |start| {
            (start.position_error, start.gradient_error)
        })
    };
    let training_time = all.iter().map(|(_, trained)| trained.training_time).sum();
    let best = all.into_iter().min_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    // There is one start at least: the file has been checked.
    let (place, best) = best.ok_or_else(|| experiment.field("starts".to_owned(), "0: at least 1".to_owned()))?;
    for name in [names::MODEL, names::LOSSES] {
        let (from, to) = (place.join(name), directory.join(name));
        fs::copy(&from, &to).map_err(|source| ExperimentError::file("write", &to, source))?;
    }
    Ok(Trained {
        starts,
        training_time,
        ..best
    })
}

/// Where the network of a start is.
fn directory_name(number: u64) -> String {
    format!("{PREFIX}{number}")
}

/// What the names of these directories begin with.
pub(super) const PREFIX: &str = "start_";

/// One row per start.
fn table(all: &[(PathBuf, Trained)]) -> String {
    let mut text = "seed,reconstruction_error_percent,gradient_error,position_error_percent\n".to_owned();
    for start in all.iter().flat_map(|(_, trained)| &trained.starts) {
        let Start {
            seed,
            reconstruction_error,
            gradient_error,
            position_error,
        } = start;
        // A String takes everything.
        let _ = writeln!(text, "{seed},{reconstruction_error},{gradient_error},{position_error}");
    }
    text
}
