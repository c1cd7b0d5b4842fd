//! `parvi report`: tables and plots of a study, or of reduced runs, again.

use std::path::PathBuf;

use clap::Args;

use super::rom;
use crate::CommandError;
use crate::study;

/// Of what.
#[derive(Args)]
pub struct Arguments {
    /// Directory of a study or of `parvi rom run`, complete or not
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

/// Reads the raw results and writes report and plots; nothing is sampled or run.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    if rom::holds_model(&arguments.directory) {
        return rom::report(&arguments.directory);
    }
    study::report(&arguments.directory)
}
