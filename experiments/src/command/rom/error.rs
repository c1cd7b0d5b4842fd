//! How an experiment's errors end the command.

use mpm_rom::experiment::ExperimentError;

use crate::CommandError;

impl From<ExperimentError> for CommandError {
    fn from(error: ExperimentError) -> Self {
        match error {
            ExperimentError::Stopped => Self::Stopped(error.into()),
            error => Self::Library(error.into()),
        }
    }
}
