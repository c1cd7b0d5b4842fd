//! Several networks for the same data.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::files::START;
use super::{Experiment, ExperimentError};
use crate::training::Training;

/// Another network: its name, and the keys of `[training]` that differ.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Variant {
    /// In tables and figures, and as the name of its directory.
    pub name: String,
    /// Keys of [`Training`] with their values.
    #[serde(flatten)]
    pub changes: toml::Table,
}

impl Experiment {
    /// The networks of the experiment: that of `[training]`, whose name is empty, and its variants.
    ///
    /// # Errors
    /// [`ExperimentError::Field`]: a key that there is not, a value out of range, a name that is no name of a directory or is used twice.
    pub fn trainings(&self) -> Result<Vec<(&str, Training)>, ExperimentError> {
        let refuse = |field: &str, message: String| Err(self.field(field, message));
        if let Err(error) = self.training.check() {
            return refuse("training", error.to_string());
        }
        let mut all = vec![("", self.training.clone())];
        let mut names = HashSet::new();
        for (number, Variant { name, changes }) in self.variants.iter().enumerate() {
            let field = format!("variants.{number}");
            let taken = name.starts_with(START);
            let sound = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
            if name.is_empty() || taken || !name.chars().all(sound) || !names.insert(name) {
                let message = format!(
                    "`{name}`: letters, digits, - and _, and a name of its own, not {}…",
                    START
                );
                return refuse(&format!("{field}.name"), message);
            }
            match self.training.changed(changes) {
                Ok(training) => all.push((name, training)),
                Err(message) => return refuse(&field, message),
            }
        }
        Ok(all)
    }
}

impl Training {
    /// With other values for some keys.
    fn changed(&self, changes: &toml::Table) -> Result<Self, String> {
        let mut table = toml::Table::try_from(self).map_err(|error| error.to_string())?;
        table.extend(changes.clone());
        let training: Self = table
            .try_into()
            .map_err(|error: toml::de::Error| error.message().to_owned())?;
        training.check().map_err(|error| error.to_string())?;
        Ok(training)
    }
}

/// Where the files of a network are: with those of the experiment, or in a directory with the variant's name beside them.
pub(super) fn directory_of(directory: &Path, name: &str) -> PathBuf {
    if name.is_empty() {
        directory.to_owned()
    } else {
        directory.join(name)
    }
}
