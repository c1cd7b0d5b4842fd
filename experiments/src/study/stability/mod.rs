//! Study `stability`: random configurations, in frames that are wrong on purpose, and how they end.
//!
//! Whatever is asked of a sampler, it gives finite particles or an error that says what went wrong. A panic or a particle that is
//! not finite is a fault; a refusal is a finding. Every case depends on the study's seed and its own number only.

mod configuration;
mod draw;
mod figure;
mod report;
mod row;
mod trial;

pub use configuration::Stability;
use draw::Case;
use row::Row;
use trial::Trial;

use super::definition::{Report, Study};
use super::directory::StudyDirectory;
use crate::CommandError;
use crate::dispatch::with_target;
use crate::options::Bounded;
use crate::progress::CaseObserver;

impl Study for Stability {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "stability";

    fn seeds(&self) -> Vec<u64> {
        vec![self.seed]
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
        with_target(&case.target, Trial { case, observer })
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
