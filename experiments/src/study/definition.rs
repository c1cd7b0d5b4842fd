//! What a study is.

use std::path::Path;

use parvi_options::{MethodSpecification, ParticleCount};
use serde::de::DeserializeOwned;

use super::directory::StudyDirectory;
use super::status::Status;
use super::yardstick::CurrentYardstick;
use crate::CommandError;
use crate::plots::page::Page;
use crate::plots::results::{Row, Rows, Value};
use crate::progress::Bar;

/// One piece of work of a study.
#[derive(Clone, Debug)]
pub struct Case<W> {
    /// What its row says before it is run: its name, made of the case's content and the same in every run, and what it is a case of.
    pub row: Row,
    /// What it is expected to cost relative to others; for the progress bar.
    pub cost: f64,
    /// The feature that the build lacks for it.
    pub lacks: Option<&'static str>,
    /// The most particles that its method is run with.
    most: Option<ParticleCount>,
    /// What is run.
    pub work: W,
}

impl<W> Case<W> {
    /// A case of this name, which costs as much as any other and ends with finite particles unless something else is noted.
    pub fn new(id: String, work: W) -> Self {
        Self {
            row: Row::of(id).with("status", Status::Finished),
            cost: 1.0,
            lacks: None,
            most: None,
            work,
        }
    }

    /// The same by a method.
    pub fn by(self, method: &MethodSpecification) -> Self {
        let (lacks, most) = (method.lacks(), method.largest_particles);
        Self { lacks, most, ..self }.with("method", method.label())
    }

    /// Whether its method is run with so many particles.
    pub fn is_due(&self) -> bool {
        let particles = self.row.count("particles").unwrap_or(0);
        self.most.is_none_or(|most| particles <= most.get())
    }

    /// Its name; it stands in results.csv and in file names.
    pub fn id(&self) -> &str {
        self.row.case()
    }

    /// The same with another cost.
    pub fn costing(self, cost: f64) -> Self {
        Self { cost, ..self }
    }

    /// The same with what else its row says.
    pub fn with(mut self, column: &'static str, value: impl Into<Value>) -> Self {
        self.row.set(column, value);
        self
    }
}

/// What a case is run with.
pub struct Tools<'a> {
    /// The yardstick of the target at hand.
    pub yardstick: &'a mut CurrentYardstick,
    /// Where raw results go.
    pub directory: &'a StudyDirectory,
    /// Watches the runs, and stops them.
    pub observer: &'a mut Bar,
}

/// Tables and plots of a study's rows, which may be a part of all; nothing is sampled. Beside their columns rows have the numbers of
/// [`derived`](super::derived); the summary of the page goes to standard output. An error is a file that cannot be read.
pub type Report<S> = fn(&S, &Rows<'_>, &StudyDirectory) -> Result<Page, CommandError>;

/// A study: its configuration but for `kind` and `threads`, which all have, is a list of cases; and the report on their rows.
pub trait Study: DeserializeOwned + Sync {
    /// What is run in a case.
    type Work: Sync;

    /// The `kind` in the configuration.
    const KIND: &'static str;

    /// The columns of results.csv with spaces between.
    const COLUMNS: &'static str;

    /// Its report.
    const REPORT: Report<Self>;

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
    fn check_earlier(&self, _rows: &[Row]) -> Result<(), CommandError> {
        Ok(())
    }

    /// All cases, in the order in which they run.
    ///
    /// # Errors
    /// Parts of the configuration that do not fit together.
    fn cases(&self) -> Result<Vec<Case<Self::Work>>, CommandError>;

    /// Runs a case and fills its row; raw results go into the directory.
    ///
    /// # Errors
    /// What ends the whole study; a run that diverges is a row.
    fn run(&self, case: &Case<Self::Work>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError>;
}
