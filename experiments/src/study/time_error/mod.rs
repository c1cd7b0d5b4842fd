//! Study `time-error`: error against wall time and evaluations, all methods on all targets.
//!
//! The yardstick is a set of independent exact draws of the same size M; where a target has none, they are drawn
//! from its reference draws. A run that diverges is a row with its reason.

mod configuration;
mod groups;
mod report;

use parvi::Run;
use serde::{Deserialize, Serialize};

pub use configuration::TimeError;

use super::attempt::{Attempt, Status};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::results;
use super::yardstick::{CurrentYardstick, Yardstick, measured_run};
use crate::CommandError;
use crate::options::{Bounded, MethodName, MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    method: MethodSpecification,
    particles: usize,
    steps: Option<usize>,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let steps = self.steps.map_or(String::new(), |steps| format!("-t{steps}"));
        format!(
            "{}-{}-m{}{steps}-s{}",
            self.target.label(),
            self.method.label(),
            self.particles,
            self.seed
        )
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }

    fn cost(&self) -> f64 {
        // Milliseconds, roughly: a distance to the reference, and M² pairs or M · 3ᵈ nodes per step.
        let steps = self.steps.unwrap_or(0) as f64;
        let dimension = self.target.dimension().unwrap_or(1) as i32;
        let per_step = match self.method.name {
            MethodName::Svgd => 10.0,
            _ => 0.03 * 3f64.powi(dimension),
        };
        100.0 + per_step * steps
    }
}

/// What a run gave. `wall_seconds` depends on the machine, everything else only on the seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    case: String,
    status: Status,
    note: String,
    target: String,
    dim: usize,
    method: String,
    particles: usize,
    steps: Option<usize>,
    seed: u64,
    score_evaluations: Option<u64>,
    density_evaluations: Option<u64>,
    wall_seconds: Option<f64>,
    energy_distance_squared: Option<f64>,
    /// Expectation of the same for M independent draws.
    energy_level: f64,
    sliced_wasserstein: Option<f64>,
    /// Largest error of a mean in standard deviations.
    mean_error: Option<f64>,
    /// Largest relative error of a standard deviation.
    deviation_error: Option<f64>,
    /// Largest error of a mode's mass.
    mass_error: Option<f64>,
    residual: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    /// Evaluations of all kinds, where both are known.
    fn evaluations(&self) -> Option<f64> {
        Some((self.score_evaluations? + self.density_evaluations?) as f64)
    }
}

impl Study for TimeError {
    type Case = Case;
    type Row = Row;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "time-error";

    fn seeds(&self) -> Vec<u64> {
        self.seeds.clone()
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.all_cases()
    }

    fn run(
        &self,
        case: &Case,
        yardstick: &mut CurrentYardstick,
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        run_case(case, yardstick.of(&case.target, &self.yardstick())?, observer)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

fn run_case(case: &Case, yardstick: &dyn Yardstick, observer: &mut CaseObserver) -> Result<Row, CommandError> {
    let mut row = Row {
        case: definition::Case::id(case),
        status: Status::Finished,
        note: String::new(),
        target: case.target.label(),
        dim: case.target.dimension()?,
        method: case.method.label().to_owned(),
        particles: case.particles,
        steps: case.steps,
        seed: case.seed,
        score_evaluations: None,
        density_evaluations: None,
        wall_seconds: None,
        energy_distance_squared: None,
        energy_level: yardstick.mean_distance() / case.particles as f64,
        sliced_wasserstein: None,
        mean_error: None,
        deviation_error: None,
        mass_error: None,
        residual: None,
    };
    let mut run = Run::new(case.particles, case.seed);
    run.start = case.method.options.start();
    let method = case.method.method(case.steps)?;
    let finished = match measured_run(&case.target, &method, &run, yardstick, observer)? {
        Attempt::Finished(finished) => finished,
        Attempt::Failed(status, reason) => {
            (row.status, row.note) = (status, reason);
            return Ok(row);
        }
    };
    if finished.from_importance_sample {
        row.note = "drawn from the importance sample".to_owned();
    }
    row.score_evaluations = Some(finished.outcome.score_evaluations);
    row.density_evaluations = Some(finished.outcome.density_evaluations);
    row.wall_seconds = Some(finished.outcome.wall_seconds);
    row.residual = finished.outcome.residual;
    match finished.errors {
        Attempt::Finished(errors) => {
            row.energy_distance_squared = Some(errors.energy_distance_squared);
            row.sliced_wasserstein = Some(errors.sliced_wasserstein);
            row.mean_error = Some(errors.mean);
            row.deviation_error = Some(errors.deviation);
            row.mass_error = errors.mass;
        }
        Attempt::Failed(status, reason) => (row.status, row.note) = (status, reason),
    }
    Ok(row)
}
