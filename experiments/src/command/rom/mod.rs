//! `parvi rom`: the reduced-order model, trained and run.

mod figures;
mod progress;
mod run;
mod train;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use mpm_rom::experiment::{Experiment, ExperimentError, names};

use super::file_kind::FileKind;
use crate::{CommandError, interrupt};

impl From<ExperimentError> for CommandError {
    fn from(error: ExperimentError) -> Self {
        match error {
            ExperimentError::Stopped => Self::Stopped(error.into()),
            error => Self::Library(error.into()),
        }
    }
}

/// What to do with a reduced-order model.
#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run the scene for all training cases and train the network; goes on with a part of it
    Train(Task),
    /// Run the test cases with the model that has been trained in the same directory
    Run(Task),
}

/// An experiment and its directory.
#[derive(Args)]
struct Task {
    /// The experiment
    #[arg(value_name = "CONFIG.toml")]
    configuration: PathBuf,
    /// Directory of data, model and tables
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Trains or runs.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let (task, work): (_, Work) = match &arguments.command {
        Command::Train(task) => (task, train::execute),
        Command::Run(task) => (task, run::execute),
    };
    FileKind::Experiment.check(&task.configuration)?;
    let experiment = Experiment::read(&task.configuration)?;
    interrupt::listen_once_begun();
    work(&experiment, &task.out)
}

/// What is done with an experiment in its directory.
type Work = fn(&Experiment, &Path) -> Result<(), CommandError>;

/// Figures and means of the reduced runs of a directory again.
pub fn report(directory: &Path) -> Result<(), CommandError> {
    if !directory.join(names::RESULTS).exists() {
        return Err(CommandError::Refused(format!(
            "{} holds a model and no reduced runs: `parvi rom run` with its experiment makes them",
            directory.display()
        )));
    }
    run::report(&Experiment::read(&directory.join(names::CONFIG))?, directory)
}
