//! From the file to the experiment.

use std::path::Path;

use super::more_runs::{MoreRuns, TRAINED_AS};
use super::{Experiment, ExperimentError};

impl Experiment {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// [`ExperimentError::File`], [`ExperimentError::Syntax`], [`ExperimentError::Field`].
    pub fn read(file: &Path) -> Result<Self, ExperimentError> {
        let bytes = std::fs::read(file).map_err(|source| ExperimentError::file("read", file, source))?;
        let text = mpm_document::text(bytes, file)?;
        Self::parse(&text, file)
    }

    /// As [`read`](Self::read), of a text; `file` is where it lies. A text with `trained_as` is completed by the file that it names.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, ExperimentError> {
        let experiment = match MoreRuns::parse(text, file)? {
            Some(more) => {
                let other = more.other_file(file)?;
                let refused = |message| ExperimentError::field(file, TRAINED_AS, message);
                let unreadable = |source| refused(format!("cannot read {}: {source}", other.display()));
                let text = mpm_document::text(std::fs::read(&other).map_err(unreadable)?, &other)?;
                if MoreRuns::parse(&text, &other)?.is_some() {
                    let message = format!("{} names a further file itself", more.trained_as.display());
                    return Err(refused(message));
                }
                more.completed(Self::parse(&text, &other)?, file)
            }
            None => Self {
                file: file.to_owned(),
                text: text.to_owned(),
                ..mpm_document::parse(text, file)?
            },
        };
        experiment.check()?;
        Ok(experiment)
    }
}
