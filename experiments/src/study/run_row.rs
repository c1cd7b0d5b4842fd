//! What a run gave, as several studies write it.

use parvi::{Method, Run};
use serde::{Deserialize, Serialize};

use super::attempt::{Attempt, Status};
use super::definition::{Case, Report};
use super::results;
use super::yardstick::{Errors, Yardstick, measured_run};
use crate::CommandError;
use crate::options::{MethodSpecification, TargetSpecification};
use crate::plots::LineSeries;
use crate::plots::page::Page;
use crate::progress::CaseObserver;
use crate::sampling::Outcome;
use crate::statistics::summarize;

/// The columns that studies share; a study writes those that it lists. Those that begin with `wall` depend on the machine, the others
/// only on the seeds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunRow {
    /// The case's name.
    pub case: String,
    /// How the run ended.
    pub status: Status,
    /// Why it gave nothing.
    #[serde(default)]
    pub reason: String,
    /// The same, and what is to be known of a run that gave particles.
    #[serde(default)]
    pub note: String,
    /// What the sampler says of its own particles, e.g. `converged`; empty where it says nothing.
    pub outcome: Option<String>,
    /// The target's label.
    #[serde(default)]
    pub target: String,
    /// The seed that makes the target.
    pub target_seed: Option<u64>,
    /// d.
    #[serde(default)]
    pub dim: usize,
    /// The method's label.
    #[serde(default)]
    pub method: String,
    /// What tables and figures tell runs apart by: the method or the basis.
    #[serde(default)]
    pub series: String,
    /// Mean of the start law in target scales; empty for draws.
    pub start_mean: Option<f64>,
    /// Standard deviation of the start law in target scales; empty for draws.
    pub start_sd: Option<f64>,
    /// M.
    #[serde(default)]
    pub particles: usize,
    /// What is varied, where several things are.
    #[serde(default)]
    pub sweep: String,
    /// k: the nodes per axis of the box that holds the target.
    pub nodes_per_axis: Option<usize>,
    /// The spacing in units of the default, where it was asked for so.
    pub spacing_factor: Option<f64>,
    /// The spacing h asked for.
    pub requested_spacing: Option<f64>,
    /// The steps asked for.
    pub requested_steps: Option<usize>,
    /// Seed of the run.
    pub seed: Option<u64>,
    /// Squared energy distance.
    pub energy_distance_squared: Option<f64>,
    /// Expectation of the same for M independent draws, E‖Y − Y'‖ / M.
    pub energy_level: Option<f64>,
    /// Sliced Wasserstein distance of order 2.
    pub sliced_wasserstein: Option<f64>,
    /// The median of the same over sets of M independent draws.
    pub sliced_level: Option<f64>,
    /// Largest error of a mean, in standard deviations.
    pub mean_error: Option<f64>,
    /// Largest relative error of a standard deviation.
    pub deviation_error: Option<f64>,
    /// max_ij |Ĉ − I|_ij.
    pub covariance_error: Option<f64>,
    /// Largest error of a mode's mass, for targets with modes.
    pub mass_error: Option<f64>,
    /// The method's log Z less the target's.
    pub log_evidence_deviation: Option<f64>,
    /// What the method says of it, as a standard error.
    pub log_evidence_error: Option<f64>,
    /// Residual relative to i.i.d. draws.
    pub residual: Option<f64>,
    /// (Σ w)² / Σ w² of an importance sample.
    pub effective_sample_size: Option<f64>,
    /// Steps taken.
    pub steps: Option<usize>,
    /// Evaluations of the score at one point.
    pub score_evaluations: Option<u64>,
    /// Evaluations of the log density at one point.
    pub density_evaluations: Option<u64>,
    /// Spacing h used, in frame units.
    pub spacing: Option<f64>,
    /// Nodes with mass in the last step.
    pub active_nodes: Option<usize>,
    /// Bytes that particles and grid hold.
    pub storage_bytes: Option<usize>,
    /// Rise of the resident memory of a process that does the run alone.
    pub memory_peak_bytes: Option<u64>,
    /// Time of the sampler alone.
    pub wall_seconds: Option<f64>,
    /// The median of the same over several runs, by the steps.
    pub wall_seconds_per_step: Option<f64>,
    /// The least.
    pub wall_seconds_per_step_least: Option<f64>,
    /// The largest.
    pub wall_seconds_per_step_most: Option<f64>,
}

impl results::Row for RunRow {
    fn case(&self) -> &str {
        &self.case
    }
}

/// A quantity of a row, where the run has it.
pub type Quantity = fn(&RunRow) -> Option<f64>;
/// Squared energy distance.
pub const ENERGY: Quantity = |row| row.energy_distance_squared;
/// Its root, the energy distance.
pub const ENERGY_ROOT: Quantity = |row| row.energy_distance_squared.map(|value| value.max(0.0).sqrt());
/// ED² relative to independent draws.
pub const ENERGY_RATIO: Quantity = |row| Some(row.energy_distance_squared? / row.energy_level?);
/// SW₂.
pub const SLICED: Quantity = |row| row.sliced_wasserstein;
/// SW₂ relative to independent draws.
pub const SLICED_RATIO: Quantity = |row| Some(row.sliced_wasserstein? / row.sliced_level?);
/// Wall time.
pub const SECONDS: Quantity = |row| row.wall_seconds;
/// Evaluations of all kinds, where both are known.
pub const EVALUATIONS: Quantity = |row| Some((row.score_evaluations? + row.density_evaluations?) as f64);
/// Active nodes per particle.
pub const NODES_PER_PARTICLE: Quantity = |row| Some(row.active_nodes? as f64 / row.particles as f64);

impl RunRow {
    /// A row of a run that has not begun.
    pub fn new(case: &impl Case) -> Self {
        Self {
            case: case.id(),
            ..Self::default()
        }
    }

    /// The same, of a method on a target.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn on(
        case: &impl Case,
        target: &TargetSpecification,
        method: &MethodSpecification,
    ) -> Result<Self, CommandError> {
        Ok(Self {
            target: target.label(),
            dim: target.dimension()?,
            method: method.label().to_owned(),
            ..Self::new(case)
        })
    }

    /// Runs a method on a target and notes what comes of it; whether the particles are independent draws from an importance sample.
    ///
    /// # Errors
    /// As for [`measured_run`].
    pub fn run(
        &mut self,
        target: &TargetSpecification,
        method: &Method,
        run: &Run,
        yardstick: &dyn Yardstick,
        observer: &mut CaseObserver,
    ) -> Result<bool, CommandError> {
        match measured_run(target, method, run, yardstick, observer)? {
            Attempt::Failed(status, reason) => {
                self.fail(status, reason);
                Ok(false)
            }
            Attempt::Finished(finished) => {
                self.take(&finished.outcome);
                self.measured(finished.errors);
                Ok(finished.from_importance_sample)
            }
        }
    }

    /// Notes what the sampler says; hands the particles on, if there are some.
    pub fn note(&mut self, attempt: Attempt<Outcome>) -> Option<Outcome> {
        match attempt {
            Attempt::Failed(status, reason) => {
                self.fail(status, reason);
                None
            }
            Attempt::Finished(outcome) => {
                self.take(&outcome);
                Some(outcome)
            }
        }
    }

    /// Notes what the sampler says of particles.
    pub fn take(&mut self, outcome: &Outcome) {
        let certificate = outcome.certificate.as_ref();
        self.outcome = certificate.map(|certificate| certificate.outcome.name().to_owned());
        self.log_evidence_deviation = outcome.log_evidence_deviation;
        self.log_evidence_error = outcome.log_evidence_error;
        self.residual = outcome.residual;
        self.steps = Some(outcome.steps);
        self.score_evaluations = Some(outcome.score_evaluations);
        self.density_evaluations = Some(outcome.density_evaluations);
        self.spacing = outcome.spacing;
        self.active_nodes = outcome.active_nodes;
        self.storage_bytes = outcome.storage_bytes;
        self.wall_seconds = Some(outcome.wall_seconds);
    }

    /// Notes the errors of the particles, or why there are none.
    pub fn measured(&mut self, errors: Attempt<Errors>) {
        match errors {
            Attempt::Failed(status, reason) => self.fail(status, reason),
            Attempt::Finished(errors) => {
                self.energy_distance_squared = Some(errors.energy_distance_squared);
                self.sliced_wasserstein = Some(errors.sliced_wasserstein);
                self.mean_error = Some(errors.mean);
                self.deviation_error = Some(errors.deviation);
                self.mass_error = errors.mass;
            }
        }
    }

    /// Notes a run without particles.
    pub fn fail(&mut self, status: Status, reason: String) {
        self.status = status;
        self.note.clone_from(&reason);
        self.reason = reason;
    }

    /// Whether the run claims to stand for the target.
    pub fn claims(&self) -> bool {
        self.outcome.as_deref() == Some("converged")
    }

    /// Whether it gave particles.
    pub fn finished(&self) -> bool {
        self.status == Status::Finished
    }

    /// How it ended, with the reason.
    pub fn ending(&self) -> String {
        match self.reason.as_str() {
            "" => self.status.as_str().to_owned(),
            reason => format!("{}: {reason}", self.status.as_str()),
        }
    }

    /// The row as an item of a list of runs that gave nothing.
    pub fn failure(&self) -> String {
        // A study writes one of both.
        let reason = if self.reason.is_empty() {
            &self.note
        } else {
            &self.reason
        };
        format!("- `{}`: {}: {reason}", self.case, self.status.as_str())
    }
}

/// The values of a quantity in those rows that have it.
pub fn values<R>(rows: &[&R], quantity: impl Fn(&R) -> Option<f64>) -> Vec<f64> {
    rows.iter().filter_map(|row| quantity(row)).collect()
}

/// The median of a quantity over the rows that have it.
pub fn median<R>(rows: &[&R], quantity: impl Fn(&R) -> Option<f64>) -> Option<f64> {
    summarize(&values(rows, quantity)).ok().map(|summary| summary.median)
}

/// A line through the medians of a quantity over the runs at each abscissa, with bars from the least to the largest.
pub fn curve<'a>(
    label: impl Into<String>,
    points: impl IntoIterator<Item = (f64, Vec<&'a RunRow>)>,
    quantity: Quantity,
) -> LineSeries {
    let mut line = LineSeries::named(label);
    for (x, runs) in points {
        line.push_median(x, &values(&runs, quantity));
    }
    line
}

/// The runs that gave nothing, each as an item of a list.
pub fn failures<'a>(rows: impl IntoIterator<Item = &'a RunRow>) -> Vec<String> {
    let failed = rows.into_iter().filter(|row| !row.finished());
    failed.map(RunRow::failure).collect()
}

/// The report of a page that ends with the runs that gave nothing, and how many these are.
pub fn report_of_runs(mut page: Page, rows: &[RunRow]) -> Report {
    let failed = failures(rows);
    page.list("Runs that did not finish", &failed, None);
    Report::new(page).with("cases", rows.len()).with("failed", failed.len())
}
