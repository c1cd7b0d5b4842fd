//! Study `basis-comparison`: which basis gives the smallest energy distance from N(0, I) for its time.
//!
//! A basis with few nodes per particle has cheap steps, a smooth one needs fewer or resolves more. Each basis is run at
//! several spacings and numbers of steps; its best spacing at the largest number of steps stands for it.

mod choice;
mod configuration;
mod report;

pub use configuration::BasisComparison;

use super::definition::{Report, Study};
use super::directory::StudyDirectory;
use super::gaussian_runs::{Case, Row, run_case};
use crate::CommandError;
use crate::options::Bounded;
use crate::progress::CaseObserver;

impl Study for BasisComparison {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "basis-comparison";

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
