//! Study `spacing-particles`: the energy distance from N(0, I) against the spacing h and the number of particles M together.
//!
//! At a fixed spacing the error falls with M until the grid, not the particles, limits it; at fixed M it has a best spacing.

mod configuration;
mod curves;
mod report;

pub use configuration::SpacingParticles;

use super::definition::Report;
use super::directory::StudyDirectory;
use super::gaussian_runs::{GaussianStudy, Row};
use crate::CommandError;

impl GaussianStudy for SpacingParticles {
    const KIND: &'static str = "spacing-particles";

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
