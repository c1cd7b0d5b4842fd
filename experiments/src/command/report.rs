//! `parvi report`: tables and plots of a study, or of reduced runs, again.

use std::path::PathBuf;

use clap::Args;

use super::rom;
use crate::CommandError;
use crate::study;

/// The file that tells the directory of a reduced-order model.
const MODEL: &str = "model.safetensors";

/// Of what.
#[derive(Args)]
pub struct Arguments {
    /// Directory of a study or of `parvi rom run`, complete or not
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

/// Reads the raw results and writes report and plots; nothing is sampled or run.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    if arguments.directory.join(MODEL).exists() {
        return rom::report(&arguments.directory);
    }
    study::report(&arguments.directory)
}

#[cfg(all(test, feature = "rom"))]
mod tests {
    #[test]
    fn a_model_is_found_by_the_name_that_training_gives_it() {
        assert_eq!(super::MODEL, mpm_rom::experiment::names::MODEL);
    }
}
