//! Study `time-to-equal-error`: the wall time to the same squared energy distance, a method of M particles against its rivals.
//!
//! The method runs with its defaults; the median over the seeds of its squared energy distance e is what its rivals have to reach. A
//! Markov chain gets more and more draws, doubled from one search to the next, all of which count; its warm-up counts for its time
//! only. Other particles get more and more steps. Of n independent draws the expectation is exact, E‖Y − Y'‖/n, so that n = E‖Y − Y'‖/e
//! are needed, n/M for each particle; only the time of their exact sampler is measured. Distances are taken in coordinates in which the
//! target has mean zero and unit covariance.

mod configuration;
mod figure;
mod report;
mod row;
mod run;
mod runs;
mod search;

use std::path::PathBuf;

pub use configuration::TimeToEqualError;
use row::Row;

use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::yardstick::CurrentYardstick;
use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;

/// One method on one target for one M, with all seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    particles: usize,
    /// 0 for the method whose error is to be reached, then its rivals.
    index: usize,
    method: MethodSpecification,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("{}-m{}-{}", self.target.label(), self.particles, self.method.label())
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }

    fn cost(&self) -> f64 {
        // Rivals get many runs, each with a distance to the reference.
        if self.index == 0 { 1.0 } else { 10.0 }
    }
}

impl Case {
    /// The file of its runs.
    fn trials_file(&self, directory: &StudyDirectory) -> PathBuf {
        let target = self.target.label();
        directory.raw(&format!(
            "{target}-m{}-{}-{}.csv",
            self.particles, self.index, self.method.name
        ))
    }
}

impl Study for TimeToEqualError {
    type Case = Case;
    type Row = Row;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "time-to-equal-error";

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
        directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let yardstick = yardstick.of(&case.target, &self.yardstick())?;
        run::run(self, case, yardstick, directory, observer)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
