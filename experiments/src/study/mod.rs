//! Studies: lists of cases with their raw results, tables and plots in one directory.

mod accuracy;
mod attempt;
mod basis_comparison;
mod catalogue;
mod checks;
mod configuration;
mod contestant;
mod covariance_spacing;
mod definition;
mod derived;
mod directory;
mod evidence;
mod gaussian_runs;
mod manifest;
mod own_process;
mod paper;
mod places;
mod prelude;
mod quickstart;
mod random_targets;
mod reference;
mod results;
mod row;
pub mod row_file;
mod runner;
mod sampled;
mod scaling;
#[cfg(feature = "mechanics")]
mod scenes;
mod search;
mod seed_range;
mod spacing_particles;
mod stability;
mod start_law;
mod status;
mod time_error;
mod time_to_equal_error;
mod time_to_level;
mod trials;
mod value;
mod yardstick;

use std::path::Path;

use configuration::Configuration;
use definition::Study;
use directory::StudyDirectory;

pub use attempt::Failure;
pub use directory::CONFIGURATION;

use crate::CommandError;

/// What can be done with a configuration of one kind.
struct Kind {
    name: &'static str,
    run: fn(&Configuration, &Path) -> Result<(), CommandError>,
    report: fn(&Configuration, &StudyDirectory) -> Result<(), CommandError>,
}

impl Kind {
    const fn of<S: Study>() -> Self {
        Self {
            name: S::KIND,
            run: runner::run::<S>,
            report: runner::report::<S>,
        }
    }

    /// A kind that this build lacks.
    #[cfg(not(feature = "mechanics"))]
    const fn of_scenes() -> Self {
        const LEFT_OUT: CommandError = CommandError::LeftOut {
            asked: "a study of scenes",
            feature: "mechanics",
        };
        Self {
            name: "scenes",
            run: |_, _| Err(LEFT_OUT),
            report: |_, _| Err(LEFT_OUT),
        }
    }

    /// The kind of a configuration.
    fn find(configuration: &Configuration) -> Result<&'static Self, CommandError> {
        let known = KINDS.iter().find(|kind| kind.name == configuration.kind());
        known.ok_or_else(|| {
            let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
            configuration.unknown_kind(&names)
        })
    }
}

/// All kinds; a new one has its `mod` line above and its line here.
static KINDS: &[Kind] = &[
    Kind::of::<quickstart::Quickstart>(),
    Kind::of::<scaling::Scaling>(),
    Kind::of::<time_error::TimeError>(),
    Kind::of::<covariance_spacing::CovarianceSpacing>(),
    Kind::of::<accuracy::Accuracy>(),
    Kind::of::<time_to_level::TimeToLevel>(),
    Kind::of::<basis_comparison::BasisComparison>(),
    Kind::of::<spacing_particles::SpacingParticles>(),
    Kind::of::<catalogue::Catalogue>(),
    Kind::of::<random_targets::RandomTargets>(),
    Kind::of::<evidence::Evidence>(),
    Kind::of::<stability::Stability>(),
    Kind::of::<paper::Paper>(),
    Kind::of::<time_to_equal_error::TimeToEqualError>(),
    #[cfg(feature = "mechanics")]
    Kind::of::<scenes::Scenes>(),
    #[cfg(not(feature = "mechanics"))]
    Kind::of_scenes(),
];

/// Runs the study that a configuration describes.
pub fn run(configuration: &Path, out: &Path) -> Result<(), CommandError> {
    let configuration = Configuration::read(configuration)?;
    (Kind::find(&configuration)?.run)(&configuration, out)
}

/// Writes the report of a directory again.
pub fn report(path: &Path) -> Result<(), CommandError> {
    let (directory, configuration) = StudyDirectory::existing(path)?;
    (Kind::find(&configuration)?.report)(&configuration, &directory)
}
