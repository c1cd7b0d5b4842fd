//! Study `time-error`: error against wall time and score evaluations, all methods on all targets.
//!
//! The yardstick is a set of independent exact draws of the same size M; where a target has none, they are drawn
//! from its reference draws. A run that diverges is a row with its reason.

mod configuration;
mod groups;
mod report;
mod yardstick;

use parvi::{Method, Run};
use serde::{Deserialize, Serialize};

pub use configuration::TimeError;
use yardstick::Yardstick;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::results;
use crate::CommandError;
use crate::options::{Bounded, MethodName, MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target_index: usize,
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

/// The reference of the target at hand.
#[derive(Default)]
pub struct Shared {
    current: Option<(usize, Box<dyn Yardstick>)>,
}

impl Study for TimeError {
    type Case = Case;
    type Row = Row;
    type Shared = Shared;

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
        shared: &mut Shared,
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let yardstick = match shared.current.take() {
            Some((index, yardstick)) if index == case.target_index => yardstick,
            _ => yardstick::build(&case.target, self)?,
        };
        let row = run_case(case, yardstick.as_ref(), observer);
        shared.current = Some((case.target_index, yardstick));
        row
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
        wall_seconds: None,
        energy_distance_squared: None,
        energy_level: yardstick.mean_distance() / case.particles as f64,
        sliced_wasserstein: None,
        mean_error: None,
        deviation_error: None,
        mass_error: None,
        residual: None,
    };
    let outcome = match sample(case, yardstick, observer)? {
        Attempt::Finished((outcome, note)) => {
            row.note = note.to_owned();
            outcome
        }
        Attempt::Failed(status, reason) => {
            (row.status, row.note) = (status, reason);
            return Ok(row);
        }
    };

    row.score_evaluations = Some(outcome.score_evaluations);
    row.wall_seconds = Some(outcome.wall_seconds);
    row.residual = outcome.residual;
    // A cloud so far out that a distance overflows has diverged as well.
    match yardstick.measure(&outcome.particles) {
        Ok(errors) => {
            row.energy_distance_squared = Some(errors.energy_distance_squared);
            row.sliced_wasserstein = Some(errors.sliced_wasserstein);
            row.mean_error = Some(errors.mean);
            row.deviation_error = Some(errors.deviation);
            row.mass_error = errors.mass;
        }
        Err(CommandError::Metric(error)) => {
            (row.status, row.note) = (Status::Diverged, results::single_line(error));
        }
        Err(error) => return Err(error),
    }
    Ok(row)
}

/// The particles of a case and a note on them.
fn sample(
    case: &Case,
    yardstick: &dyn Yardstick,
    observer: &mut CaseObserver,
) -> Result<Attempt<(Outcome, &'static str)>, CommandError> {
    let method = case.method.method(case.steps)?;
    if method == Method::Iid && !yardstick.has_exact_draws() {
        let outcome = yardstick.resample(case.particles, case.seed)?;
        return Ok(Attempt::Finished((outcome, "drawn from the importance sample")));
    }
    let mut run = Run::new(case.particles, case.seed);
    run.start = case.method.options.start();
    attempt(sampling::sample(&case.target, &method, &run, observer).map(|outcome| (outcome, "")))
}
