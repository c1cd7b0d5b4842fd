//! Study `spacing-particles`: the energy distance from N(0, I) against the spacing h and the number of particles M together.
//!
//! At a fixed spacing the error falls with M until the grid, not the particles, limits it; at fixed M it has a best spacing.

mod configuration;
mod curves;
mod report;

pub use configuration::SpacingParticles;

use super::definition::{Report, Study};
use super::directory::StudyDirectory;
use super::gaussian_runs::{Case, Row, run_case};
use crate::CommandError;
use crate::options::Bounded;
use crate::progress::CaseObserver;

impl Study for SpacingParticles {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "spacing-particles";

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
