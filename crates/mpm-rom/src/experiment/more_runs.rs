//! Files that ask for other runs of what another file trains.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::{Cases, Experiment, ExperimentError, ReducedRuns};

/// The key that such files have.
pub(super) const TRAINED_AS: &str = "trained_as";

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

impl MoreRuns {
    /// The document, if it has the key `trained_as`.
    pub fn parse(text: &str, file: &Path) -> Result<Option<Self>, ExperimentError> {
        let document: toml::Table = mpm_document::parse(text, file)?;
        let is_one = document.contains_key(TRAINED_AS);
        is_one.then(|| Ok(mpm_document::parse(text, file)?)).transpose()
    }

    /// The file of the other experiment; `file` is that of this one.
    pub fn other_file(&self, file: &Path) -> Result<PathBuf, ExperimentError> {
        // Paths are seen from the file, so that both have to lie in one place.
        let name = self.trained_as.display();
        if self.trained_as.file_name() != Some(self.trained_as.as_os_str()) {
            let message = format!("{name}: a file beside this one is needed, by its name alone");
            return Err(ExperimentError::field(file, TRAINED_AS, message));
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
