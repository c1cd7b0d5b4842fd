//! The command line: one subcommand per file.

mod file_kind;
#[cfg(any(test, not(all(feature = "mechanics", feature = "rom"))))]
mod left_out;
mod report;
#[cfg(feature = "rom")]
mod rom;
mod run;
mod sample;
#[cfg(feature = "mechanics")]
mod simulate;
mod targets;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use parvi::SampleError;

use crate::{CommandError, console, interrupt};
#[cfg(not(feature = "rom"))]
use left_out::rom;
#[cfg(not(feature = "mechanics"))]
use left_out::simulate;

/// Particle-based variational inference by the material point method.
#[derive(Parser)]
#[command(name = "parvi", version, about, arg_required_else_help = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// List the targets: names, dimensions, parameters and what is known about each
    Targets,
    /// Sample a target and write the particles to a file
    Sample(Box<sample::Arguments>),
    /// Run a study; resumes if the directory holds a part of it
    Run(run::Arguments),
    /// Simulate a scene of the material point method; resumes if the directory holds a part of it
    Simulate(simulate::Arguments),
    /// Train or run a reduced-order model of the material point method
    Rom(rom::Arguments),
    /// Write tables and plots of a study again from its raw results
    Report(report::Arguments),
}

/// Parses the arguments of the process, does what they say and gives the exit code: 0 for success, 1 for an error,
/// 2 for a command line that makes no sense, 130 for an interruption.
pub fn main() -> ExitCode {
    let line = match parsed() {
        Ok(line) => line,
        Err(error) => {
            // Help and version come as errors that belong on standard output; clap knows.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    let result = match line.command {
        Command::Targets => targets::execute(),
        Command::Sample(arguments) => sample::execute(&arguments),
        Command::Run(arguments) => run::execute(&arguments),
        Command::Simulate(arguments) => simulate::execute(&arguments),
        Command::Rom(arguments) => rom::execute(&arguments),
        Command::Report(arguments) => report::execute(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            console::notice(&format!("error: {error}"));
            ExitCode::from(exit_code(&error))
        }
    }
}

/// The arguments of the process; help says of every option which methods have it.
fn parsed() -> Result<CommandLine, clap::Error> {
    let command = CommandLine::command().mut_subcommand("sample", sample::with_owners);
    CommandLine::from_arg_matches(&command.try_get_matches()?)
}

/// What a line asks of a method, a target or a build that they do not have is a line that makes no sense to them.
fn exit_code(error: &CommandError) -> u8 {
    match error {
        CommandError::Files(error) if error.is_of_request() => 2,
        CommandError::Flag(_)
        | CommandError::OtherKind(_)
        | CommandError::LeftOut { .. }
        | CommandError::Sample(
            SampleError::InvalidOption { .. }
            | SampleError::NotTaken { .. }
            | SampleError::Unsupported { .. }
            | SampleError::ScoreOnly { .. }
            | SampleError::NotBuilt { .. },
        ) => 2,
        error if error.is_interruption() => interrupt::EXIT_CODE,
        _ => 1,
    }
}
