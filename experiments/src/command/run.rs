//! `parvi run`: a study from its configuration.

use std::path::PathBuf;

use clap::Args;

use super::file_kind::FileKind;
use crate::study;
use crate::{CommandError, interrupt};

/// What to run and where.
#[derive(Args)]
pub struct Arguments {
    /// The study's configuration
    #[arg(value_name = "CONFIG.toml")]
    configuration: PathBuf,
    /// Directory of the results; a part of the same study in it is continued
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the cases that are missing, then writes the report.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    FileKind::Study.check(&arguments.configuration)?;
    interrupt::listen();
    study::run(&arguments.configuration, &arguments.out)
}
