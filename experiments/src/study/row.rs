//! A line of results: cells by the names of their columns.

use std::collections::BTreeMap;

use super::attempt::{Failure, attempt};
use super::status::Status;
use super::value::{ENDINGS, Value};
use super::yardstick::Errors;
use crate::CommandError;
use crate::plots::page::Cell;
use crate::sampling::Outcome;

/// What a case gave. Columns that begin with `wall` depend on the machine, the others only on the seeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    cells: BTreeMap<&'static str, Value>,
}

impl Row {
    /// The row of a case of this name.
    pub fn of(case: impl Into<Value>) -> Self {
        Self::default().with("case", case)
    }

    /// The same with one cell more.
    pub fn with(mut self, column: &'static str, value: impl Into<Value>) -> Self {
        self.set(column, value);
        self
    }

    /// Fills a cell.
    pub fn set(&mut self, column: &'static str, value: impl Into<Value>) {
        self.cells.insert(column, value.into());
    }

    /// A cell.
    pub fn value(&self, column: &str) -> &Value {
        self.cells.get(column).unwrap_or(&Value::Empty)
    }

    /// A word; empty where there is none.
    pub fn text(&self, column: &str) -> &str {
        match self.value(column) {
            Value::Text(text) => text,
            _ => "",
        }
    }

    /// A number.
    pub fn number(&self, column: &str) -> Option<f64> {
        match self.value(column) {
            Value::Number(number) => Some(*number),
            Value::Count(count) => Some(*count as f64),
            _ => None,
        }
    }

    /// A whole number.
    pub fn count(&self, column: &str) -> Option<usize> {
        match self.value(column) {
            Value::Count(count) => usize::try_from(*count).ok(),
            _ => None,
        }
    }

    /// Whether a cell holds this.
    pub fn is(&self, column: &str, value: impl Into<Value>) -> bool {
        *self.value(column) == value.into()
    }

    /// Cells as they stand in a table, by names with ` | ` between them.
    pub fn cells(&self, columns: &str) -> Vec<String> {
        columns.split(" | ").map(|column| self.value(column).cell()).collect()
    }

    /// The name of the case.
    pub fn case(&self) -> &str {
        self.text("case")
    }

    /// How the run ended; with finite particles unless something else is noted.
    pub fn status(&self) -> Status {
        let noted = ENDINGS.iter().find_map(|column| Status::of(self.text(column)));
        noted.unwrap_or_default()
    }

    /// Whether it gave particles.
    pub fn finished(&self) -> bool {
        self.status() == Status::Finished
    }

    /// Whether the run claims to stand for the target.
    pub fn claims(&self) -> bool {
        self.text("outcome") == "converged"
    }

    /// How it ended, with the reason.
    pub fn ending(&self) -> String {
        match self.text("reason") {
            "" => self.status().as_str().to_owned(),
            reason => format!("{}: {reason}", self.status().as_str()),
        }
    }

    /// The row as an item of a list of runs that gave nothing.
    pub fn failure(&self) -> String {
        // A study writes one of both.
        let reason = match self.text("reason") {
            "" => self.text("note"),
            reason => reason,
        };
        format!("- `{}`: {}: {reason}", self.case(), self.status().as_str())
    }

    /// Notes a run without particles.
    pub fn fail(&mut self, failure: Failure) {
        self.set("status", failure.status.as_str());
        self.set("note", failure.reason.as_str());
        self.set("reason", failure.reason);
    }

    /// Notes what the sampler says; hands the particles on, if there are some.
    ///
    /// # Errors
    /// What [`attempt`] does not take for a result.
    pub fn note(&mut self, sampled: Result<Outcome, CommandError>) -> Result<Option<Outcome>, CommandError> {
        match attempt(sampled)? {
            Ok(outcome) => {
                self.take(&outcome);
                Ok(Some(outcome))
            }
            Err(failure) => {
                self.fail(failure);
                Ok(None)
            }
        }
    }

    /// Notes what the sampler says of particles.
    pub fn take(&mut self, outcome: &Outcome) {
        let certificate = outcome.certificate.as_ref();
        self.set("outcome", certificate.map(|certificate| certificate.outcome.name()));
        self.set("log_evidence_deviation", outcome.log_evidence_deviation);
        self.set("log_evidence_error", outcome.log_evidence_error);
        self.set("residual", outcome.residual);
        self.set("steps", outcome.steps);
        self.set("score_evaluations", outcome.score_evaluations);
        self.set("density_evaluations", outcome.density_evaluations);
        self.set("spacing", outcome.spacing);
        self.set("active_nodes", outcome.active_nodes);
        self.set("storage_bytes", outcome.storage_bytes);
        self.set("wall_seconds", outcome.wall_seconds);
    }

    /// Notes the errors of the particles, or why there are none.
    ///
    /// # Errors
    /// What [`attempt`] does not take for a result.
    pub fn measured(&mut self, errors: Result<Errors, CommandError>) -> Result<(), CommandError> {
        match attempt(errors)? {
            Err(failure) => self.fail(failure),
            Ok(errors) => {
                self.set("energy_distance_squared", errors.energy_distance_squared);
                self.set("sliced_wasserstein", errors.sliced_wasserstein);
                self.set("mean_error", errors.mean);
                self.set("deviation_error", errors.deviation);
                self.set("mass_error", errors.mass);
            }
        }
        Ok(())
    }
}
