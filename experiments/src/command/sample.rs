//! `parvi sample`: particles of one target by one method, into one file.

use std::path::{Path, PathBuf};

use clap::Args;
use parvi::{Checkpoint, Method, MpmOptions, Run};

use crate::diagnostics::diagnose;
use crate::machine::MemoryGauge;
use crate::options::{
    Dimension, MethodName, MethodOptions, OptionError, ParticleCount, StepCount, TargetParameters, TargetSpecification,
};
use crate::output::{AtomicFile, ParticleFile, ParticleFormat};
use crate::progress::StepProgress;
use crate::sampling::{self, Outcome};
use crate::{CommandError, console, interrupt};

/// The key of the rise of the process's resident memory while it sampled; Linux only.
pub const PEAK_MEMORY_KEY: &str = "peak_memory_bytes";

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
    ParticleFormat::of(&arguments.out)?;
    check_files(arguments)?;
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
    warn(&outcome);
    console::print_pairs(&pairs(arguments, &outcome, peak_memory))
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

/// Refuses one file in two roles.
fn check_files(arguments: &Arguments) -> Result<(), CommandError> {
    let files = [
        ("out", Some(&arguments.out)),
        ("diagnostics", arguments.diagnostics.as_ref()),
        ("checkpoint", arguments.checkpoint.as_ref()),
        ("data", arguments.parameters.data.as_ref()),
    ];
    let given: Vec<_> = files
        .into_iter()
        .filter_map(|(name, path)| Some((name, path?, place(path?))))
        .collect();
    for (k, (name, path, own)) in given.iter().enumerate() {
        if let Some((other, ..)) = given[..k].iter().find(|(.., place)| place == own) {
            return Err(OptionError {
                name: (*name).to_owned(),
                reason: format!("{} is the file of --{other}", path.display()),
            }
            .into());
        }
    }
    Ok(())
}

/// A path in the one form that two spellings of it share, whether or not its file exists.
fn place(path: &Path) -> PathBuf {
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let directory = directory.unwrap_or(Path::new(".")).canonicalize();
    match (path.canonicalize(), directory, path.file_name()) {
        (Ok(whole), _, _) => whole,
        (_, Ok(directory), Some(name)) => directory.join(name),
        _ => path.to_owned(),
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

/// What a user should know before trusting the particles.
fn warn(outcome: &Outcome) {
    if outcome.scores_replaced > 0 {
        console::notice(&format!(
            "{} scores on the way were not finite; the particles were pulled back to where they are",
            outcome.scores_replaced
        ));
    }
    let Some(certificate) = &outcome.certificate else {
        return;
    };
    if let Some(reason) = certificate.outcome.reason() {
        console::notice(&format!("{}: {reason}", certificate.outcome.name()));
    }
    if certificate.mass_left_out > 0.0 {
        console::notice(&format!(
            "there are too few particles for pieces of the target with a mass of {:.3}, which are left out",
            certificate.mass_left_out
        ));
    }
    if let Some(error) = certificate.mass_error {
        console::notice(&format!(
            "the target has separate pieces: residual and scores are blind to their masses, which leave an error of {error:.3} standard \
             deviations in a mean"
        ));
    }
}

/// What the certificate says.
fn certificate_pairs(outcome: &Outcome) -> Vec<(&'static str, String)> {
    let Some(certificate) = &outcome.certificate else {
        return Vec::new();
    };
    let numbers = [
        ("mean_error", certificate.mean_error()),
        ("sd_error", certificate.standard_deviation_error()),
        ("unexplained", certificate.unexplained()),
        ("mass_error", certificate.mass_error),
        ("drift", Some(certificate.drift)),
    ];
    let mut pairs = vec![("outcome", certificate.outcome.name().to_owned())];
    pairs.extend(certificate.outcome.reason().map(|reason| ("reason", reason)));
    pairs.extend(
        numbers
            .into_iter()
            .filter_map(|(key, value)| Some((key, value?.to_string()))),
    );
    pairs
}

/// What standard output says; a key without a value is left out.
fn pairs(arguments: &Arguments, outcome: &Outcome, peak_memory: Option<u64>) -> Vec<(&'static str, String)> {
    let mut pairs = vec![
        ("method", arguments.method.to_string()),
        ("steps", outcome.steps.to_string()),
        ("score_evaluations", outcome.score_evaluations.to_string()),
        ("wall_seconds", format!("{:.6}", outcome.wall_seconds)),
    ];
    let optional = [
        ("residual", outcome.residual.map(|value| value.to_string())),
        ("spacing", outcome.spacing.map(|value| value.to_string())),
        ("active_nodes", outcome.active_nodes.map(|value| value.to_string())),
        ("bodies", outcome.bodies.map(|value| value.to_string())),
        ("storage_bytes", outcome.storage_bytes.map(|value| value.to_string())),
        ("divergences", outcome.divergences.map(|value| value.to_string())),
        (PEAK_MEMORY_KEY, peak_memory.map(|value| value.to_string())),
    ];
    pairs.extend(optional.into_iter().filter_map(|(key, value)| Some((key, value?))));
    pairs.extend(certificate_pairs(outcome));
    pairs.extend([
        ("target", arguments.target.clone()),
        ("dim", outcome.particles.dimension().to_string()),
        ("particles", outcome.particles.len().to_string()),
        ("seed", arguments.seed.to_string()),
    ]);
    pairs
}
