//! The directory of an experiment.

use std::path::{Path, PathBuf};

use mpm_scenes::output::write_whole;
use serde::Deserialize;
use toml::Spanned;

use super::{Cases, Experiment, ExperimentError};

/// Names of the files.
pub mod names {
    /// The experiment's file as it was trained or run last.
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
    /// Takes a directory for this experiment, which may hold a part of it. What the training does not hang on may have changed since: title, test cases and reduced runs. So may the networks where none has a state yet, and
    /// everything where there are no data either.
    pub(super) fn occupy(&self, directory: &Path) -> Result<(), ExperimentError> {
        create(directory)?;
        let file = directory.join(names::CONFIG);
        if file.exists() && !holds_no_more_than(directory, &[names::CONFIG])? {
            let of_data = [names::CONFIG, names::SCENE, names::TRAINING_DATA];
            let is_untrained = holds_no_more_than(directory, &of_data)?;
            let before = Self::read(&file).map(|before| {
                let networks = if is_untrained { self } else { &before };
                Self {
                    title: self.title.clone(),
                    cases: Cases {
                        train: before.cases.train.clone(),
                        ..self.cases.clone()
                    },
                    run: self.run.clone(),
                    training: networks.training.clone(),
                    variants: networks.variants.clone(),
                    starts: networks.starts,
                    file: self.file.clone(),
                    text: self.text.clone(),
                    ..before
                }
            });
            if !before.is_ok_and(|before| before == *self) {
                return Err(ExperimentError::Occupied {
                    directory: directory.display().to_string(),
                });
            }
        }
        write(&file, &titled(&self.text, &self.title))
    }
}

/// A file that a run needs of the training.
pub(super) fn made_by_training(file: PathBuf) -> Result<PathBuf, ExperimentError> {
    if file.exists() {
        return Ok(file);
    }
    let file = file.display().to_string();
    Err(ExperimentError::Untrained { file })
}

/// Whether a directory has nothing but files of these names.
fn holds_no_more_than(directory: &Path, names: &[&str]) -> Result<bool, ExperimentError> {
    let of = |source| ExperimentError::file("read", directory, source);
    for entry in std::fs::read_dir(directory).map_err(of)? {
        let name = entry.map_err(of)?.file_name();
        if !names.iter().any(|known| name == **known) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The text of an experiment with this title, which may be that of other runs of it.
fn titled(text: &str, title: &str) -> String {
    #[derive(Deserialize)]
    struct Head {
        title: Spanned<String>,
    }
    match toml::from_str::<Head>(text) {
        Ok(head) if head.title.get_ref() != title => {
            let place = head.title.span();
            let title = toml::Value::from(title).to_string();
            [&text[..place.start], &title, &text[place.end..]].concat()
        }
        _ => text.to_owned(),
    }
}

/// What the names of the directories begin with that hold networks of which the best is kept.
pub(super) const START: &str = "start_";

/// A directory, with those above it.
pub(super) fn create(directory: &Path) -> Result<(), ExperimentError> {
    std::fs::create_dir_all(directory).map_err(|source| ExperimentError::file("create", directory, source))
}

/// A text file, whole or not at all.
pub(super) fn write(file: &Path, text: &str) -> Result<(), ExperimentError> {
    Ok(write_whole(file, text.as_bytes())?)
}
