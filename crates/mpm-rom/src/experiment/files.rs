//! The directory of an experiment.

use std::path::Path;

use mpm_scenes::output::write_whole;

use super::{Cases, Experiment, ExperimentError};

/// Names of the files.
pub mod names {
    /// The experiment's file as it was trained.
    pub const CONFIG: &str = "config.toml";
    /// The scene's file as the training runs were made of it.
    pub const SCENE: &str = "scene.toml";
    /// Snapshots of the training runs.
    pub const TRAINING_DATA: &str = "training_data.safetensors";
    /// The state of the training.
    pub const CHECKPOINT: &str = "checkpoint.safetensors";
    /// The trained model.
    pub const MODEL: &str = "model.safetensors";
    /// One row per network, where the best of several is kept.
    pub const STARTS: &str = "starts.csv";
    /// One row per epoch.
    pub const LOSSES: &str = "losses.csv";
    /// One row per reduced run.
    pub const RESULTS: &str = "results.csv";
    /// One row per frame of every reduced run.
    pub const FRAMES: &str = "frames.csv";
}

impl Experiment {
    /// Takes a directory for this experiment, which may hold a part of it. What the training does not hang on may have changed since: title, test cases and reduced runs.
    pub(super) fn occupy(&self, directory: &Path) -> Result<(), ExperimentError> {
        std::fs::create_dir_all(directory).map_err(|source| ExperimentError::file("create", directory, source))?;
        let file = directory.join(names::CONFIG);
        if !file.exists() {
            return write(&file, &self.text);
        }
        let before = Self::read(&file).map(|before| Self {
            title: self.title.clone(),
            cases: Cases {
                train: before.cases.train,
                ..self.cases.clone()
            },
            run: self.run.clone(),
            file: self.file.clone(),
            text: self.text.clone(),
            ..before
        });
        match before {
            Ok(before) if before == *self => Ok(()),
            _ => Err(ExperimentError::Occupied {
                directory: directory.display().to_string(),
            }),
        }
    }
}

/// What the names of the directories begin with that hold networks of which the best is kept.
pub(super) const START: &str = "start_";

/// A text file, whole or not at all.
pub(super) fn write(file: &Path, text: &str) -> Result<(), ExperimentError> {
    Ok(write_whole(file, text.as_bytes())?)
}
