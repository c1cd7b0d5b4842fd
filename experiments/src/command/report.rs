//! `parvi report`: tables and plots of a study again.

use std::path::PathBuf;

use clap::Args;

use crate::CommandError;
use crate::study;

/// Which study.
#[derive(Args)]
pub struct Arguments {
    /// Directory of a study, complete or not
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

/// Reads the raw results and writes report and plots; nothing is sampled.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    study::report(&arguments.directory)
}
