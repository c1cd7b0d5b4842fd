//! A row of the study `catalogue`.

use serde::{Deserialize, Serialize};

use super::Case;
use crate::CommandError;
use crate::sampling::Outcome;
use crate::study::attempt::Status;
use crate::study::yardstick::{Errors, Yardstick};
use crate::study::{definition, results};

/// What a run gave. Columns that begin with `wall` depend on the machine; the others only on the seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case's name.
    pub case: String,
    /// How the run ended.
    pub status: Status,
    /// Why it gave nothing.
    pub reason: String,
    /// What the sampler says of its own particles, e.g. `converged`; empty where it says nothing.
    pub outcome: Option<String>,
    /// The target's label.
    pub target: String,
    /// d.
    pub dim: usize,
    /// The method's label.
    pub method: String,
    /// Mean of the start law in target scales; empty for draws.
    pub start_mean: Option<f64>,
    /// Standard deviation of the start law in target scales; empty for draws.
    pub start_sd: Option<f64>,
    /// M.
    pub particles: usize,
    /// Seed of the run.
    pub seed: u64,
    /// Squared energy distance in standardised coordinates.
    pub energy_distance_squared: Option<f64>,
    /// Expectation of the same for M independent draws, E‖Y − Y'‖ / M.
    pub energy_level: f64,
    /// Sliced Wasserstein distance of order 2 in standardised coordinates.
    pub sliced_wasserstein: Option<f64>,
    /// The median of the same over sets of M independent draws.
    pub sliced_level: Option<f64>,
    /// Largest error of a mean in standard deviations.
    pub mean_error: Option<f64>,
    /// Largest relative error of a standard deviation.
    pub deviation_error: Option<f64>,
    /// Largest error of a mode's mass, for targets with modes.
    pub mass_error: Option<f64>,
    /// Residual relative to i.i.d. draws.
    pub residual: Option<f64>,
    /// Steps taken.
    pub steps: Option<usize>,
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

/// A quantity of a row, where the run has it.
pub type Quantity = fn(&Row) -> Option<f64>;
/// ED² relative to independent draws.
pub const ENERGY: Quantity = |row| Some(row.energy_distance_squared? / row.energy_level);
/// SW₂ relative to independent draws.
pub const SLICED: Quantity = |row| Some(row.sliced_wasserstein? / row.sliced_level?);

impl Row {
    /// A row of a run that has not begun.
    pub fn new(case: &Case, yardstick: &dyn Yardstick) -> Result<Self, CommandError> {
        Ok(Self {
            case: definition::Case::id(case),
            status: Status::Finished,
            reason: String::new(),
            outcome: None,
            target: case.target.label(),
            dim: case.target.dimension()?,
            method: case.method.label().to_owned(),
            start_mean: case.start.map(|start| start.mean),
            start_sd: case.start.map(|start| start.standard_deviation),
            particles: case.particles,
            seed: case.seed,
            energy_distance_squared: None,
            energy_level: yardstick.mean_distance() / case.particles as f64,
            sliced_wasserstein: None,
            sliced_level: yardstick.sliced_level(),
            mean_error: None,
            deviation_error: None,
            mass_error: None,
            residual: None,
            steps: None,
            score_evaluations: None,
            density_evaluations: None,
            wall_seconds: None,
        })
    }

    /// Evaluations of all kinds, where both are known.
    pub fn evaluations(&self) -> Option<f64> {
        Some((self.score_evaluations? + self.density_evaluations?) as f64)
    }

    /// Notes what the sampler says.
    pub fn take(&mut self, outcome: &Outcome) {
        let certificate = outcome.certificate.as_ref();
        self.outcome = certificate.map(|certificate| certificate.outcome.name().to_owned());
        self.residual = outcome.residual;
        self.steps = Some(outcome.steps);
        self.score_evaluations = Some(outcome.score_evaluations);
        self.density_evaluations = Some(outcome.density_evaluations);
        self.wall_seconds = Some(outcome.wall_seconds);
    }

    /// Notes the errors of the particles.
    pub fn measured(&mut self, errors: &Errors) {
        self.energy_distance_squared = Some(errors.energy_distance_squared);
        self.sliced_wasserstein = Some(errors.sliced_wasserstein);
        self.mean_error = Some(errors.mean);
        self.deviation_error = Some(errors.deviation);
        self.mass_error = errors.mass;
    }
}

#[cfg(test)]
impl Row {
    /// A finished run of a method of which nothing else is known.
    pub fn example(method: &str) -> Self {
        Self {
            case: String::new(),
            status: Status::Finished,
            reason: String::new(),
            outcome: None,
            target: String::new(),
            dim: 1,
            method: method.to_owned(),
            start_mean: None,
            start_sd: None,
            particles: 2,
            seed: 0,
            energy_distance_squared: None,
            energy_level: 1.0,
            sliced_wasserstein: None,
            sliced_level: None,
            mean_error: None,
            deviation_error: None,
            mass_error: None,
            residual: None,
            steps: None,
            score_evaluations: None,
            density_evaluations: None,
            wall_seconds: None,
        }
    }
}
