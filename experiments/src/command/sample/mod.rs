//! `parvi sample`: particles of one target by one method, into one file.

mod files;
mod said;

use std::path::PathBuf;

use clap::Args;
use parvi::{Checkpoint, Method, MpmOptions, Run};

use crate::diagnostics::diagnose;
use crate::machine::MemoryGauge;
use crate::options::{
    Dimension, MethodName, MethodOptions, OptionError, ParticleCount, StepCount, TargetParameters, TargetSpecification,
};
use crate::output::{AtomicFile, ParticleFile, ParticleFormat};
use crate::progress::StepProgress;
use crate::sampling;
use crate::{CommandError, console, interrupt};

pub use said::PEAK_MEMORY_KEY;

/// Target, method and file.
#[derive(Args)]
pub struct Arguments {
    /// Target, see `parvi targets`
    #[arg(long, value_name = "NAME")]
    target: String,
    /// Dimension from 1 to 8, where the target leaves it free
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    dim: Option<Dimension>,
    /// Number of particles, at least 2
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    particles: ParticleCount,
    /// Method
    #[arg(long, value_enum, default_value_t)]
    method: MethodName,
    /// Seed of every random choice
    #[arg(long, value_name = "S", default_value_t = 0, allow_negative_numbers = true)]
    seed: u64,
    /// File of the particles, .csv or .npy
    #[arg(long, value_name = "FILE.csv|.npy")]
    out: PathBuf,
    /// File of diagnostics: moments with errors, quantiles, discrepancies
    #[arg(long, value_name = "FILE.json")]
    diagnostics: Option<PathBuf>,
    /// File of the run's state; a run that was stopped goes on from it to the same bits (mpm)
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Write the checkpoint every so many steps
    #[arg(
        long,
        value_name = "STEPS",
        default_value = "32",
        requires = "checkpoint",
        allow_negative_numbers = true
    )]
    checkpoint_every: StepCount,
    #[command(flatten)]
    parameters: TargetParameters,
    #[command(flatten)]
    options: MethodOptions,
}

/// Samples and writes; nothing stands under the file's name unless all of it is finite.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let method = with_checkpoint(arguments.options.method(arguments.method)?, arguments)?;
    let pool = arguments.options.pool_file(arguments.method);
    ParticleFormat::of("out", &arguments.out)?;
    if let Some(path) = pool {
        ParticleFormat::of("pool", path)?;
    }
    files::check(arguments)?;
    let target = TargetSpecification {
        name: arguments.target.clone(),
        dim: arguments.dim,
        parameters: arguments.parameters.clone(),
    };
    let mut run = Run::new(arguments.particles.get(), arguments.seed);
    run.start = arguments.options.start();
    target.dimension().map_err(|error| of_flags(error.into()))?;
    let names = match arguments.parameters.data {
        Some(_) => target.coordinate_names(),
        None => Vec::new(),
    };
    let file = ParticleFile::create(&arguments.out)?;
    let pool = pool.map(ParticleFile::create).transpose()?;
    let diagnostics = arguments.diagnostics.as_ref().map(AtomicFile::create).transpose()?;
    interrupt::listen();
    let mut progress = StepProgress::new();
    let memory = MemoryGauge::begin();
    let outcome = sampling::sample(&target, &method, &run, &mut progress).map_err(of_flags)?;
    let peak_memory = memory.peak_bytes();
    progress.clear();
    if let Some(mut diagnostics) = diagnostics {
        let content = diagnose(&target, &outcome)?;
        diagnostics.fill(|writer| Ok(serde_json::to_writer_pretty(writer, &content)?))?;
        diagnostics.commit()?;
    }
    file.write(&outcome.particles, &names)?;
    said::warn(&outcome);
    if let Some(file) = pool {
        file.write(outcome.pool.as_ref().ok_or(CommandError::NoPool)?, &names)?;
    }
    console::print_pairs(&said::pairs(arguments, &outcome, peak_memory))
}

/// An error of a target that a flag asks for is one of this flag.
fn of_flags(error: CommandError) -> CommandError {
    match error {
        CommandError::Target(error) => match OptionError::of_target(&error) {
            Some(error) => error.into(),
            None => error.into(),
        },
        error => error,
    }
}

/// The method with the checkpoint that was asked for.
fn with_checkpoint(method: Method, arguments: &Arguments) -> Result<Method, CommandError> {
    match (method, &arguments.checkpoint) {
        (Method::Mpm(options), Some(path)) => Ok(Method::Mpm(MpmOptions {
            checkpoint: Some(Checkpoint {
                path: path.clone(),
                every: arguments.checkpoint_every.get(),
            }),
            ..options
        })),
        (Method::OnMesh(_), Some(path)) => Err(OptionError {
            name: "checkpoint".to_owned(),
            reason: format!("{}: sampling on a mesh has no checkpoint", path.display()),
        }
        .into()),
        (_, Some(path)) => {
            Err(OptionError::misfit("checkpoint", &path.display().to_string(), arguments.method.as_str()).into())
        }
        (method, None) => Ok(method),
    }
}
