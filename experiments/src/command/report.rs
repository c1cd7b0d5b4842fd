//! `parvi report`: tables and plots of a study, of reduced runs or of a simulated scene, again.

use std::path::PathBuf;

use clap::Args;

use super::file_kind::FileKind;
use super::{rom, simulate};
use crate::CommandError;
use crate::study::{self, CONFIGURATION};

/// The file that tells the directory of a reduced-order model.
const MODEL: &str = "model.safetensors";

/// The file that tells the directory of a simulated scene.
const SCENE: &str = "scene.toml";

/// Of what.
#[derive(Args)]
pub struct Arguments {
    /// Directory of a study, of `parvi simulate` or of `parvi rom run`, complete or not
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

/// Reads the raw results and writes report and plots; nothing is sampled or run.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let directory = &arguments.directory;
    std::fs::read_dir(directory).map_err(|source| CommandError::file("read", directory, source))?;
    if directory.join(MODEL).exists() {
        return rom::report(directory);
    }
    if FileKind::of_file(&directory.join(CONFIGURATION)) == Some(FileKind::Experiment) {
        let directory = directory.display();
        return Err(CommandError::Refused(format!(
            "{directory} holds a training that is not finished: the same `parvi rom train` goes on with it, and reports are of reduced runs"
        )));
    }
    if directory.join(SCENE).exists() {
        return simulate::report(directory);
    }
    study::report(directory)
}

#[cfg(all(test, feature = "mechanics", feature = "rom"))]
mod tests {
    #[test]
    fn a_model_is_found_by_the_name_that_training_gives_it() {
        assert_eq!(super::MODEL, mpm_rom::experiment::names::MODEL);
    }

    #[test]
    fn a_scene_is_found_by_the_name_that_simulating_gives_it() {
        assert_eq!(super::SCENE, mpm_scenes::output::names::SCENE);
    }
}
