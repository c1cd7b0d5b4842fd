//! A row of the study `random-targets`.

use serde::{Deserialize, Serialize};

use super::Case;
use crate::sampling::Outcome;
use crate::study::attempt::Status;
use crate::study::{definition, results};

/// What a run gave. `wall_seconds` depends on the machine, everything else only on the seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case's name.
    pub case: String,
    /// How the run ended.
    pub status: Status,
    /// Why it gave nothing.
    pub reason: String,
    /// d.
    pub dim: usize,
    /// The seed that makes the target.
    pub target_seed: u64,
    /// The method's label.
    pub method: String,
    /// What the sampler says of its own particles, e.g. `converged`; empty where it says nothing.
    pub outcome: Option<String>,
    /// Squared energy distance in standard deviations per axis.
    pub energy_distance_squared: Option<f64>,
    /// Expectation of the same for M independent draws, E‖Y − Y'‖ / M.
    pub energy_level: f64,
    /// The method's log Z less the target's.
    pub log_evidence_deviation: Option<f64>,
    /// What the method says of it, as a standard error.
    pub log_evidence_error: Option<f64>,
    /// Evaluations of the score at one point.
    pub score_evaluations: Option<u64>,
    /// Evaluations of the log density at one point.
    pub density_evaluations: Option<u64>,
    /// Time of the sampler alone.
    pub wall_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    /// A row of a run that has not begun; `energy_level` is that of independent draws.
    pub fn new(case: &Case, energy_level: f64) -> Self {
        Self {
            case: definition::Case::id(case),
            status: Status::Finished,
            reason: String::new(),
            dim: case.dim,
            target_seed: case.target_seed,
            method: case.method.label().to_owned(),
            outcome: None,
            energy_distance_squared: None,
            energy_level,
            log_evidence_deviation: None,
            log_evidence_error: None,
            score_evaluations: None,
            density_evaluations: None,
            wall_seconds: None,
        }
    }

    /// Notes what the sampler says; `log_evidence` is the target's.
    pub fn take(&mut self, outcome: &Outcome, log_evidence: Option<f64>) {
        let certificate = outcome.certificate.as_ref();
        self.outcome = certificate.map(|certificate| certificate.outcome.name().to_owned());
        self.log_evidence_deviation = outcome
            .log_evidence
            .zip(log_evidence)
            .map(|(found, exact)| found - exact);
        self.log_evidence_error = outcome.log_evidence_error;
        self.score_evaluations = Some(outcome.score_evaluations);
        self.density_evaluations = Some(outcome.density_evaluations);
        self.wall_seconds = Some(outcome.wall_seconds);
    }

    /// ED² relative to independent draws.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.energy_distance_squared? / self.energy_level)
    }

    /// Evaluations of all kinds.
    pub fn evaluations(&self) -> Option<f64> {
        Some((self.score_evaluations? + self.density_evaluations?) as f64)
    }

    /// Whether log Z is within three of its standard errors; `None` where the method does not state it.
    pub fn states_evidence(&self) -> Option<bool> {
        Some(self.log_evidence_deviation?.abs() <= 3.0 * self.log_evidence_error?)
    }

    /// Whether the run claims to stand for the target.
    pub fn claims(&self) -> bool {
        self.outcome.as_deref() == Some("converged")
    }

    /// Whether it does so and is no better than independent draws.
    pub fn claims_falsely(&self) -> bool {
        self.claims() && self.ratio().is_none_or(|ratio| ratio > 1.0)
    }
}
