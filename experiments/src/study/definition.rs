//! What a study is.

use std::path::Path;

use serde::de::DeserializeOwned;

use super::directory::StudyDirectory;
use super::results::Row;
use crate::CommandError;
use crate::options::MethodSpecification;
use crate::plots::page::Page;
use crate::progress::CaseObserver;

/// One piece of work of a study.
pub trait Case: Sync {
    /// A name made of the case's content, the same in every run; it stands in results.csv and in file names.
    fn id(&self) -> String;

    /// The method that it runs, where this build may lack it.
    fn method(&self) -> Option<&MethodSpecification> {
        None
    }

    /// What the case is expected to cost relative to others; for the progress bar.
    fn cost(&self) -> f64 {
        1.0
    }
}

/// What a case is run with.
pub struct Work<'a, S> {
    /// What earlier cases left in memory.
    pub shared: &'a mut S,
    /// Where raw results go.
    pub directory: &'a StudyDirectory,
    /// Watches the runs, and stops them.
    pub observer: &'a mut CaseObserver,
}

/// A study: its configuration, which is a list of cases, and the report on their rows.
pub trait Study: DeserializeOwned + Sync {
    /// A case.
    type Case: Case;
    /// What a case gives.
    type Row: Row + Send + Sync;
    /// What one case may leave in memory for the next, such as a reference that is dear to compute.
    type Shared: Default;

    /// The `kind` in the configuration.
    const KIND: &'static str;

    /// The keys of the configuration that are read before its kind is known; the study has the others.
    const HEAD: &[&str] = &["kind", "threads"];

    /// The columns of results.csv with spaces between, where they are not all that a row has.
    const COLUMNS: &'static str = "";

    /// Reads and checks the files that the configuration names, relative to its own file. Before a run, not for a report.
    ///
    /// # Errors
    /// A file that cannot be read, or does not fit the configuration.
    fn open(&mut self, _configuration: &Path) -> Result<(), CommandError> {
        Ok(())
    }

    /// Checks that rows of an earlier start are of the files that [`open`](Self::open) has read.
    ///
    /// # Errors
    /// A case whose files have changed.
    fn check_earlier(&self, _rows: &[Self::Row]) -> Result<(), CommandError> {
        Ok(())
    }

    /// The seeds, for the manifest, where `seed` or `seeds` of the configuration do not say them.
    fn seeds(&self) -> Vec<u64> {
        Vec::new()
    }

    /// All cases, in the order in which they run.
    ///
    /// # Errors
    /// Parts of the configuration that do not fit together.
    fn cases(&self) -> Result<Vec<Self::Case>, CommandError>;

    /// Runs a case; raw results go into the directory, the row is appended by the caller.
    ///
    /// # Errors
    /// What ends the whole study; a run that diverges is a row.
    fn run(&self, case: &Self::Case, work: Work<'_, Self::Shared>) -> Result<Self::Row, CommandError>;

    /// Tables and plots of the rows, which may be a part of all; nothing is sampled.
    fn report(&self, rows: &[Self::Row], directory: &StudyDirectory) -> Result<Report, CommandError>;
}

/// What a report says.
pub struct Report {
    /// The page with its figures.
    pub page: Page,
    /// The most important of it, as `key=value` lines for standard output.
    pub summary: Vec<(&'static str, String)>,
}

impl Report {
    /// A page, and nothing beside it.
    pub fn new(page: Page) -> Self {
        let summary = Vec::new();
        Self { page, summary }
    }

    /// The same with a line more.
    pub fn with(mut self, key: &'static str, value: impl ToString) -> Self {
        self.summary.push((key, value.to_string()));
        self
    }
}
