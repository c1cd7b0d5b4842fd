//! What studies note in a row of results, and what they say of several.

use parvi_files::Outcome;

use super::attempt::{Failure, attempt};
use super::status::Status;
use super::value::ENDINGS;
use super::yardstick::Errors;
use crate::CommandError;
use crate::plots::page::Page;
use crate::plots::results::{Row, Rows};

/// A run as a row. Columns that begin with `wall` depend on the machine, the others only on the seeds.
pub trait RunRow {
    /// How the run ended; with finite particles unless something else is noted.
    fn status(&self) -> Status;

    /// Whether it gave particles.
    fn finished(&self) -> bool {
        self.status() == Status::Finished
    }

    /// Whether the run claims to stand for the target.
    fn claims(&self) -> bool;

    /// How it ended, with the reason.
    fn ending(&self) -> String;

    /// The row as an item of a list of runs that gave nothing.
    fn failure(&self) -> String;

    /// Notes a run without particles.
    fn fail(&mut self, failure: Failure);

    /// The same with the reason in a word or two beside what was said, and the step in which it happened.
    fn fail_in(&mut self, place: (&str, Option<usize>), failure: Failure);

    /// Notes what the sampler says; hands the particles on, if there are some.
    ///
    /// # Errors
    /// What [`attempt`] does not take for a result.
    fn note(&mut self, sampled: Result<Outcome, CommandError>) -> Result<Option<Outcome>, CommandError>;

    /// Notes what the sampler says of particles.
    fn take(&mut self, outcome: &Outcome);

    /// Notes the errors of the particles, or why there are none.
    ///
    /// # Errors
    /// What [`attempt`] does not take for a result.
    fn measured(&mut self, errors: Result<Errors, CommandError>) -> Result<(), CommandError>;
}

impl RunRow for Row {
    fn status(&self) -> Status {
        let noted = ENDINGS.iter().find_map(|column| Status::of(self.text(column)));
        noted.unwrap_or_default()
    }

    fn claims(&self) -> bool {
        self.text("outcome") == "converged"
    }

    fn ending(&self) -> String {
        match self.text("reason") {
            "" => self.status().to_string(),
            reason => format!("{}: {reason}", self.status()),
        }
    }

    fn failure(&self) -> String {
        // A study writes one of both.
        let reasons = ["reason", "note"].map(|column| self.text(column));
        let reason = reasons.iter().find(|reason| !reason.is_empty()).unwrap_or(&"");
        format!("- `{}`: {}: {reason}", self.case(), self.status())
    }

    fn fail(&mut self, failure: Failure) {
        self.set("status", failure.status);
        self.set("note", failure.reason.as_str());
        self.set("reason", failure.reason);
    }

    fn fail_in(&mut self, (reason, step): (&str, Option<usize>), failure: Failure) {
        self.set("ending", failure.status);
        self.set("message", failure.reason.as_str());
        self.fail(failure);
        self.set("reason", reason);
        self.set("failed_step", step);
    }

    fn note(&mut self, sampled: Result<Outcome, CommandError>) -> Result<Option<Outcome>, CommandError> {
        let outcome = attempt(sampled)?.map_err(|failure| self.fail(failure)).ok();
        if let Some(outcome) = &outcome {
            self.take(outcome);
        }
        Ok(outcome)
    }

    fn take(&mut self, outcome: &Outcome) {
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

    fn measured(&mut self, errors: Result<Errors, CommandError>) -> Result<(), CommandError> {
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

/// Several runs.
pub trait RunRows: Sized {
    /// How many gave particles, of how many.
    fn finished(&self) -> String;

    /// A page whose summary says how many ended so.
    fn tell<const N: usize>(&self, endings: [Status; N], page: Page) -> Page;

    /// The runs that claim to stand for the target with more than so much in a column, or nothing.
    fn false_claims(&self, column: &str, most: f64) -> Self;

    /// The runs on targets that there is something to hold particles against.
    fn held(&self) -> Self;

    /// Says on a page how well the samples are known that stand for targets, and of which targets none does.
    fn references(&self, page: &mut Page);

    /// The runs that gave nothing, each as an item of a list.
    fn failures(&self) -> Vec<String>;

    /// A page that ends with the runs that gave nothing, and how many these are.
    fn close(&self, page: Page) -> Page;
}

impl RunRows for Rows<'_> {
    fn finished(&self) -> String {
        format!("{}/{}", self.count(Row::finished), self.len())
    }

    fn tell<const N: usize>(&self, endings: [Status; N], page: Page) -> Page {
        let told = |page: Page, ending: Status| {
            let count = self.count(|row| row.status() == ending);
            page.with(ending.to_string().replace('-', "_"), count)
        };
        endings.into_iter().fold(page, told)
    }

    fn false_claims(&self, column: &str, most: f64) -> Self {
        self.having(|row| row.claims() && !row.is_within(column, most))
    }

    fn held(&self) -> Self {
        self.having(|row| row.status() != Status::NoReference)
    }

    fn references(&self, page: &mut Page) {
        let sampled = self.having(|row| row.number("reference_size").is_some());
        if !sampled.is_empty() {
            page.section("References", &[], sampled.lines("target", sampled.words("target")));
        }
        let without = self.having(|row| row.status() == Status::NoReference);
        page.list("Runs that are held against nothing", &without.failures(), None);
    }

    fn failures(&self) -> Vec<String> {
        self.iter().filter(|row| !row.finished()).map(Row::failure).collect()
    }

    fn close(&self, mut page: Page) -> Page {
        let failed = self.failures();
        page.list("Runs that did not finish", &failed, None);
        page.with("cases", self.len()).with("failed", failed.len())
    }
}
