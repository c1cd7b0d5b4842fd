//! Study `accuracy`: the energy distance from N(0, I) against the number of particles, all methods in all dimensions.
//!
//! Independent draws reach ED = O(M^(−1/2)); no set of M points can do better than the order M^(−(1 + 1/d)/2) of optimally
//! spread points. The bar between the two is scrambled Sobol points through the normal quantile.

mod configuration;
mod figure;
mod report;

pub use configuration::Accuracy;

use super::definition::Report;
use super::directory::StudyDirectory;
use super::gaussian_runs::{GaussianStudy, Row};
use crate::CommandError;

impl GaussianStudy for Accuracy {
    const KIND: &'static str = "accuracy";

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
