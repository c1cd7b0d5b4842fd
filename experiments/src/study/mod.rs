//! Studies: lists of cases with their raw results, tables and plots in one directory.

mod accuracy;
mod attempt;
mod basis_comparison;
mod catalogue;
mod checks;
mod configuration;
mod covariance_spacing;
mod definition;
mod directory;
mod document;
mod gaussian_runs;
mod manifest;
mod moments;
mod quickstart;
mod results;
mod runner;
mod scaling;
mod spacing_particles;
mod stability;
mod start_law;
mod target_reference;
mod time_error;
mod time_to_level;
mod trace_file;

use std::path::Path;

use configuration::Configuration;
use definition::Study;
use directory::StudyDirectory;

use crate::CommandError;

/// All kinds.
const KINDS: [&str; 10] = [
    quickstart::Quickstart::KIND,
    scaling::Scaling::KIND,
    time_error::TimeError::KIND,
    covariance_spacing::CovarianceSpacing::KIND,
    accuracy::Accuracy::KIND,
    time_to_level::TimeToLevel::KIND,
    basis_comparison::BasisComparison::KIND,
    spacing_particles::SpacingParticles::KIND,
    catalogue::Catalogue::KIND,
    stability::Stability::KIND,
];

/// Runs the study that a configuration describes.
pub fn run(configuration: &Path, out: &Path) -> Result<(), CommandError> {
    let configuration = Configuration::read(configuration)?;
    match configuration.kind() {
        quickstart::Quickstart::KIND => runner::run::<quickstart::Quickstart>(&configuration, out),
        scaling::Scaling::KIND => runner::run::<scaling::Scaling>(&configuration, out),
        time_error::TimeError::KIND => runner::run::<time_error::TimeError>(&configuration, out),
        covariance_spacing::CovarianceSpacing::KIND => {
            runner::run::<covariance_spacing::CovarianceSpacing>(&configuration, out)
        }
        accuracy::Accuracy::KIND => runner::run::<accuracy::Accuracy>(&configuration, out),
        time_to_level::TimeToLevel::KIND => runner::run::<time_to_level::TimeToLevel>(&configuration, out),
        basis_comparison::BasisComparison::KIND => {
            runner::run::<basis_comparison::BasisComparison>(&configuration, out)
        }
        spacing_particles::SpacingParticles::KIND => {
            runner::run::<spacing_particles::SpacingParticles>(&configuration, out)
        }
        catalogue::Catalogue::KIND => runner::run::<catalogue::Catalogue>(&configuration, out),
        stability::Stability::KIND => runner::run::<stability::Stability>(&configuration, out),
        _ => Err(configuration.unknown_kind(&KINDS)),
    }
}

/// Writes the report of a directory again.
pub fn report(path: &Path) -> Result<(), CommandError> {
    let (directory, configuration) = StudyDirectory::existing(path)?;
    match configuration.kind() {
        quickstart::Quickstart::KIND => runner::report::<quickstart::Quickstart>(&configuration, &directory),
        scaling::Scaling::KIND => runner::report::<scaling::Scaling>(&configuration, &directory),
        time_error::TimeError::KIND => runner::report::<time_error::TimeError>(&configuration, &directory),
        covariance_spacing::CovarianceSpacing::KIND => {
            runner::report::<covariance_spacing::CovarianceSpacing>(&configuration, &directory)
        }
        accuracy::Accuracy::KIND => runner::report::<accuracy::Accuracy>(&configuration, &directory),
        time_to_level::TimeToLevel::KIND => runner::report::<time_to_level::TimeToLevel>(&configuration, &directory),
        basis_comparison::BasisComparison::KIND => {
            runner::report::<basis_comparison::BasisComparison>(&configuration, &directory)
        }
        spacing_particles::SpacingParticles::KIND => {
            runner::report::<spacing_particles::SpacingParticles>(&configuration, &directory)
        }
        catalogue::Catalogue::KIND => runner::report::<catalogue::Catalogue>(&configuration, &directory),
        stability::Stability::KIND => runner::report::<stability::Stability>(&configuration, &directory),
        _ => Err(configuration.unknown_kind(&KINDS)),
    }
}
