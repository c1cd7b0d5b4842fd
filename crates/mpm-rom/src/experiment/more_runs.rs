//! Files that ask for other runs of what another file trains.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::config::ReducedRuns;
use super::{Cases, Experiment, ExperimentError};

/// Other test cases and reduced runs of the networks of another experiment.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MoreRuns {
    title: String,
    /// The file of that experiment, which lies beside this one.
    pub trained_as: PathBuf,
    #[serde(default)]
    cases: TestCases,
    #[serde(default)]
    run: ReducedRuns,
}

/// The test cases; those of the other file if left out.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct TestCases {
    test: Option<Vec<Vec<f64>>>,
}

/// Whether there is the key.
#[derive(Deserialize)]
struct Kind {
    trained_as: Option<toml::Value>,
}

impl MoreRuns {
    /// The document, if it has the key `trained_as`.
    pub fn parse(text: &str, file: &Path) -> Result<Option<Self>, ExperimentError> {
        match mpm_document::parse::<Kind>(text, file)?.trained_as {
            Some(_) => Ok(Some(mpm_document::parse(text, file)?)),
            None => Ok(None),
        }
    }

    /// The file of the other experiment; `file` is that of this one.
    pub fn other_file(&self, file: &Path) -> Result<PathBuf, ExperimentError> {
        // Paths are seen from the file, so that both have to lie in one place.
        let name = self.trained_as.display();
        if self.trained_as.file_name() != Some(self.trained_as.as_os_str()) {
            let message = format!("{name}: a file beside this one is needed, by its name alone");
            return Err(refused(file, message));
        }
        Ok(file.with_file_name(&self.trained_as))
    }

    /// The other experiment with this title, and these test cases and runs.
    pub fn completed(self, trained: Experiment, file: &Path) -> Experiment {
        Experiment {
            title: self.title,
            cases: Cases {
                test: self.cases.test.unwrap_or(trained.cases.test),
                ..trained.cases
            },
            run: self.run,
            file: file.to_owned(),
            ..trained
        }
    }
}

/// What is wrong with the name of the other file.
pub(super) fn refused(file: &Path, message: String) -> ExperimentError {
    ExperimentError::Field {
        file: file.display().to_string(),
        field: "trained_as".to_owned(),
        message,
    }
}
