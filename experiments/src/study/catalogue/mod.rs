//! Study `catalogue`: what the defaults of a method reach on every target, from starts near and far.
//!
//! Nothing is set per target. Errors are measured in coordinates in which the target has mean zero and unit covariance, and
//! stated relative to those of as many independent draws. The first method of the list is judged by [`requirement`]; the
//! others stand beside it.

mod claims;
mod configuration;
mod figure;
mod report;
mod requirement;
mod row;
mod yardstick;

use parvi::{Method, Run};

pub use configuration::Catalogue;
use row::Row;
use yardstick::Yardstick;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::results::single_line;
use super::start_law::StartLaw;
use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target_index: usize,
    target: TargetSpecification,
    method: MethodSpecification,
    /// `None` for draws, which have no start.
    start: Option<StartLaw>,
    particles: usize,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let start = self.start.map_or(String::new(), |start| {
            format!("-mean{}-sd{}", start.mean, start.standard_deviation)
        });
        let (target, method) = (self.target.label(), self.method.label());
        format!("{target}-{method}-m{}{start}-s{}", self.particles, self.seed)
    }

    fn cost(&self) -> f64 {
        // Milliseconds, roughly: the distance to the reference and the run; the many rows of `wells` are dear.
        let run = match self.target.name.as_str() {
            "wells" => 2000.0,
            _ => 100.0,
        };
        200.0 + if self.start.is_some() { run } else { 0.0 }
    }
}

/// The reference of the target at hand.
#[derive(Default)]
pub struct Shared {
    current: Option<(usize, Box<dyn Yardstick>)>,
}

impl Study for Catalogue {
    type Case = Case;
    type Row = Row;
    type Shared = Shared;

    const KIND: &'static str = "catalogue";

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
    let mut row = Row::new(case, yardstick)?;
    let outcome = match sample(case, yardstick, observer)? {
        Attempt::Finished(outcome) => outcome,
        Attempt::Failed(status, reason) => {
            (row.status, row.reason) = (status, reason);
            return Ok(row);
        }
    };
    row.take(&outcome);
    // A cloud so far out that a distance overflows has diverged as well.
    match yardstick.measure(&outcome.particles) {
        Ok(errors) => row.measured(&errors),
        Err(CommandError::Metric(error)) => (row.status, row.reason) = (Status::Diverged, single_line(error)),
        Err(error) => return Err(error),
    }
    Ok(row)
}

fn sample(
    case: &Case,
    yardstick: &dyn Yardstick,
    observer: &mut CaseObserver,
) -> Result<Attempt<Outcome>, CommandError> {
    let method = case.method.method(None)?;
    if method == Method::Iid && !yardstick.has_exact_draws() {
        return Ok(Attempt::Finished(yardstick.resample(case.particles, case.seed)));
    }
    let mut run = Run::new(case.particles, case.seed);
    let start = case.method.options.start();
    run.start = case.start.map_or(start, |law| law.start(start));
    attempt(sampling::sample(&case.target, &method, &run, observer))
}
