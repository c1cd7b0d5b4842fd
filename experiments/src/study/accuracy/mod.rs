//! Study `accuracy`: the energy distance from N(0, I) against the number of particles, all methods in all dimensions.
//!
//! Independent draws reach ED = O(M^(−1/2)); no set of M points can do better than the order M^(−(1 + 1/d)/2) of optimally
//! spread points. The bar between the two is scrambled Sobol points through the normal quantile.

mod configuration;
mod figure;
mod report;

pub use configuration::Accuracy;

use super::definition::{Report, Study};
use super::directory::StudyDirectory;
use super::gaussian_runs::{Case, Row, run_case};
use crate::CommandError;
use crate::options::Bounded;
use crate::progress::CaseObserver;

impl Study for Accuracy {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "accuracy";

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
        (): &mut (),
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        run_case(case, observer)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
