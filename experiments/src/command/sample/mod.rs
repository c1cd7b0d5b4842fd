//! `parvi sample`: particles of one target by one method, into one file.

mod files;
mod given;
mod said;
mod watch;

use std::path::{Path, PathBuf};

use clap::Args;
use parvi::{Checkpoint, Method, Run, SampleError};
use parvi_files::particles_csv::column_names;
use parvi_files::pictures::{History, Subject, look};
use parvi_files::{
    AtomicFile, FrameWriter, NumberTable, Outcome, OutputDirectory, ParticleFile, ParticleFormat, npy_is_built,
};
use parvi_options::{
    Dimension, MethodName, MethodOptions, OptionError, ParticleCount, StepCount, TargetParameters, TargetSpecification,
    owners, seed,
};

use crate::diagnostics::diagnose;
use crate::dispatch::on_target;
use crate::machine::MemoryGauge;
use crate::plots::results::Value;
use crate::progress::Bar;
use crate::sampling;
use crate::{CommandError, console, interrupt};
use watch::Watch;

/// Target, method and file.
#[derive(Args)]
pub struct Arguments {
    /// Target, see `parvi targets`
    #[arg(long, value_name = "NAME")]
    target: String,
    /// Dimension from 1 to 8, where the target leaves it free
    #[arg(long, value_name = "D")]
    dim: Option<Dimension>,
    /// Number of particles, at least 2; may be left out where --start has them
    #[arg(long, value_name = "M", required_unless_present = "start")]
    particles: Option<ParticleCount>,
    /// Method
    #[arg(long, value_enum, default_value_t)]
    method: MethodName,
    /// Seed of every random choice
    #[arg(long, value_name = "S", default_value_t = 0, value_parser = seed)]
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
    #[arg(long, value_name = "STEPS", default_value = "32", requires = "checkpoint")]
    checkpoint_every: StepCount,
    /// Directory for frames of the particles on their way and at the end: .npy, and .vtp with a .pvd for ParaView
    #[arg(long, value_name = "DIR")]
    frames: Option<PathBuf>,
    /// Write a frame of every K-th step
    #[arg(long, value_name = "K", default_value = "10", requires = "frames")]
    every: StepCount,
    /// Directory for pictures of the particles: marginals, corner plot, the survey by rounds, trace, and for d = 2 the cloud at six moments
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,
    #[command(flatten)]
    parameters: TargetParameters,
    #[command(flatten)]
    options: MethodOptions,
}

/// The subcommand, all of whose values may be negative numbers, and in whose help every option of methods names those that have it.
pub fn with_owners(command: clap::Command) -> clap::Command {
    command.mut_args(|argument| {
        let argument = argument.allow_negative_numbers(true);
        let owners = owners(argument.get_long().unwrap_or_default());
        let help = argument.get_help().map(ToString::to_string);
        let Some(help) = help.filter(|_| !owners.is_empty()) else {
            return argument;
        };
        let (what, default) = help.split_at(help.find(" [default").unwrap_or(help.len()));
        argument.help(format!("{what} ({owners}){default}"))
    })
}

/// Samples and writes; nothing stands under the file's name unless all of it is finite.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let method = with_checkpoint(traced(arguments).method(arguments.method)?, arguments)?;
    let pool = arguments.options.pool_file(arguments.method);
    let best = arguments.options.best.as_deref().map(Path::new);
    for (flag, path) in [("out", Some(arguments.out.as_path())), ("pool", pool), ("best", best)] {
        path.map(|path| ParticleFormat::of(flag, path)).transpose()?;
    }
    if arguments.frames.is_some() {
        npy_is_built()?;
    }
    files::check(arguments)?;
    let target = TargetSpecification {
        name: arguments.target.clone(),
        dim: arguments.dim,
        parameters: arguments.parameters.clone(),
    };
    let dimension = target.dimension().map_err(|error| of_flags(error.into(), arguments))?;
    let mut run = Run::new(particles(arguments)?, arguments.seed);
    run.start = arguments.options.start();
    let data = arguments.parameters.data.as_ref();
    let names = data.map_or(Vec::new(), |_| target.coordinate_names());
    run.given = given::given(arguments, &column_names(&names, dimension), &run)?;
    // Whoever sees a file sees a run that can be interrupted.
    interrupt::listen();
    let directory = |flag, path: &Option<PathBuf>| {
        let path = path.as_deref();
        path.map(|path| OutputDirectory::create(flag, path)).transpose()
    };
    let frames = directory("frames", &arguments.frames)?;
    let plots = directory("plots", &arguments.plots)?;
    let file = ParticleFile::create("out", &arguments.out)?;
    let pool = pool.map(|path| ParticleFile::create("pool", path)).transpose()?;
    let best = best.map(|path| ParticleFile::create("best", path)).transpose()?;
    let diagnostics = arguments.diagnostics.as_ref().map(AtomicFile::create).transpose()?;
    // Where the checkpoint exists, frames of an earlier process are those of this run.
    let goes_on = arguments.checkpoint.as_ref().is_some_and(|path| path.exists());
    let frames = frames.map(|directory| {
        let notice = |text: &str| console::notice(&format!("--frames {text}"));
        FrameWriter::new(directory, arguments.every.get(), names.clone(), goes_on, notice)
    });
    let mut watch = Watch {
        progress: Bar::counting("step"),
        frames: frames.transpose()?,
        history: plots.is_some().then(History::default),
    };
    let memory = MemoryGauge::begin();
    let sampled = sampling::sample(&target, &method, &run, &mut watch);
    let peak_memory = memory.peak_bytes();
    watch.progress.clear();
    let outcome = sampled.map_err(|error| watch.reason(resumable(of_flags(error, arguments), arguments)))?;
    file.write(&outcome.particles, &names)?;
    said::warn(arguments, &outcome, &names);
    if let Some(file) = pool {
        let nothing = || CommandError::Refused(NO_POOL.to_owned());
        file.write(outcome.pool.as_ref().ok_or_else(nothing)?, &names)?;
    }
    if let (Some(file), Some(watched)) = (best, &outcome.watched) {
        file.write(&watched.best, &names)?;
    }
    let mut pairs = said::pairs(arguments, &outcome, &names, peak_memory);
    if let Some(mut diagnostics) = diagnostics {
        let content = diagnose(&target, &outcome, &column_names(&names, dimension), &pairs)?;
        diagnostics.fill(|writer| Ok(serde_json::to_writer_pretty(writer, &content)?))?;
        diagnostics.commit()?;
    }
    if let Some(frames) = watch.frames {
        let count = frames.finish(&outcome.particles, outcome.steps)?;
        if count == 1 {
            console::notice("--frames: no particles have moved; the only frame is that of what the run returned");
        }
        pairs.push(("frames", count.into()));
    }
    if let (Some(directory), Some(history)) = (&plots, &watch.history) {
        let names = draw(arguments, &target, &outcome, history, directory)?;
        pairs.push(("plots", Value::Text(names.join(","))));
    }
    if let Method::Mpm(options) = &method
        && let Some(checkpoint) = &options.checkpoint
    {
        // Not before: whoever ends the process earlier, or a full disk, leaves the means to have every file.
        checkpoint.remove()?;
    }
    console::print_pairs(&pairs)
}

/// What is said of a pool that was asked for where there is none.
const NO_POOL: &str =
    "--pool: nothing could be weighed, so that there is no pool; the particles are those of a body without a survey";

/// Draws the pictures into a directory and returns the names of their files.
fn draw(
    arguments: &Arguments,
    target: &TargetSpecification,
    outcome: &Outcome,
    history: &History,
    directory: &OutputDirectory,
) -> Result<Vec<&'static str>, CommandError> {
    let mesh = arguments.options.mesh.as_deref().map(Path::new);
    let known = on_target!(target, target, D => Ok(look::<D>(target.as_ref(), mesh)))?;
    let checkpoint = arguments.checkpoint.as_ref();
    let subject = Subject {
        target: &target.label(),
        coordinates: &target.coordinate_names(),
        known: &known.or_pool(outcome.pool.as_ref()),
        method: arguments.method.as_str(),
        outcome,
        history,
        untraced: checkpoint.map(|_| "a run with a checkpoint has none"),
        notice: |text| console::notice(&format!("--plots: {text}")),
    };
    Ok(subject.draw(directory)?)
}

/// M, as said or as many as the file of the start has.
fn particles(arguments: &Arguments) -> Result<usize, CommandError> {
    match (arguments.particles, arguments.options.start_file()) {
        (Some(count), _) => Ok(count.get()),
        (None, Some(file)) => Ok(NumberTable::read("start", file)?.rows()),
        (None, None) => Err(OptionError::out_of_range("particles", "nothing", "a number of at least 2").into()),
    }
}

/// An error of a target, or of particles, that a flag asks for is one of this flag.
fn of_flags(error: CommandError, arguments: &Arguments) -> CommandError {
    let of_flag = match &error {
        CommandError::Sample(error) => given::flag_of(error, &arguments.options),
        CommandError::Target(error) => OptionError::of_target(error),
        _ => None,
    };
    of_flag.map_or(error, CommandError::from)
}

/// An interruption that left a checkpoint says how to go on.
fn resumable(error: CommandError, arguments: &Arguments) -> CommandError {
    match (&error, &arguments.checkpoint) {
        (CommandError::Sample(SampleError::Interrupted { step }), Some(path)) if path.exists() => {
            let file = path.display();
            CommandError::Interrupted(format!(" after step {step}: the same command goes on from {file}"))
        }
        _ => error,
    }
}

/// Records of the trace that a picture shows.
const RECORDS: usize = 25;
/// Steps that a method which is not told how many takes, about: only those between two records hang on it.
const USUAL_STEPS: usize = 100;

/// The options, with a trace where there are to be pictures of it. A checkpoint has no room for one.
fn traced(arguments: &Arguments) -> MethodOptions {
    let mut options = arguments.options.clone();
    if arguments.plots.is_some() && arguments.checkpoint.is_none() {
        let steps = options.steps.map_or(USUAL_STEPS, StepCount::get);
        options.trace_every = (steps / RECORDS).max(1);
    }
    options
}

/// The method with the checkpoint that was asked for.
fn with_checkpoint(method: Method, arguments: &Arguments) -> Result<Method, CommandError> {
    let Some(path) = &arguments.checkpoint else {
        return Ok(method);
    };
    let shown = path.display().to_string();
    let refused = match method {
        Method::Mpm(mut options) => {
            options.checkpoint = Some(Checkpoint {
                path: path.clone(),
                every: arguments.checkpoint_every.get(),
            });
            return Ok(Method::Mpm(options));
        }
        Method::OnMesh(_) => {
            let reason = format!("{shown}: sampling on a mesh has no checkpoint");
            OptionError::new("checkpoint", reason)
        }
        _ => OptionError::misfit("checkpoint", &shown, arguments.method.as_str()),
    };
    Err(refused.into())
}
