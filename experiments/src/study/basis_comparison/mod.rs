//! Study `basis-comparison`: which basis gives the smallest energy distance from N(0, I) for its time.
//!
//! A basis with few nodes per particle has cheap steps, a smooth one needs fewer or resolves more. Each basis is run at
//! several spacings and numbers of steps; its best spacing at the largest number of steps stands for it.

mod choice;
mod configuration;
mod report;

pub use configuration::BasisComparison;

use super::definition::Report;
use super::directory::StudyDirectory;
use super::gaussian_runs::{GaussianStudy, Row};
use crate::CommandError;

impl GaussianStudy for BasisComparison {
    const KIND: &'static str = "basis-comparison";

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
