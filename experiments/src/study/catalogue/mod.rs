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

use parvi::Run;

pub use configuration::Catalogue;
use row::Row;

use super::attempt::Attempt;
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::start_law::StartLaw;
use super::yardstick::{CurrentYardstick, Yardstick, measured_run};
use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
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

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
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

impl Study for Catalogue {
    type Case = Case;
    type Row = Row;
    type Shared = CurrentYardstick;

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
    let mut row = Row::new(case, yardstick)?;
    let mut run = Run::new(case.particles, case.seed);
    let start = case.method.options.start();
    run.start = case.start.map_or(start, |law| law.start(start));
    match measured_run(&case.target, &case.method.method(None)?, &run, yardstick, observer)? {
        Attempt::Finished(finished) => {
            row.take(&finished.outcome);
            match finished.errors {
                Attempt::Finished(errors) => row.measured(&errors),
                Attempt::Failed(status, reason) => (row.status, row.reason) = (status, reason),
            }
        }
        Attempt::Failed(status, reason) => (row.status, row.reason) = (status, reason),
    }
    Ok(row)
}
