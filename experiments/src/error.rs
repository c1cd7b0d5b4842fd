//! The one error type of the command.

use std::path::Path;

use mpm_document::DocumentError;
use parvi::SampleError;
use parvi_files::FileError;
use parvi_metrics::MetricError;
use parvi_options::OptionError;
use parvi_targets::TargetError;
use thiserror::Error;

use crate::plots::PlotError;
use crate::statistics::StatisticsError;
use crate::study::Failure;

/// Everything that ends a command early, with the file, line, field or flag and the value that did it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CommandError {
    /// A target, its parameters or its data are wrong.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// A sampler gave no particles.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// What a library says that not every build has: of a scene, a simulation, an experiment with a reduced-order model.
    #[error(transparent)]
    Library(Box<dyn std::error::Error + Send + Sync>),
    /// Ctrl-C, as such a library says it.
    #[error(transparent)]
    Stopped(Box<dyn std::error::Error + Send + Sync>),
    /// The build lacks a part of the command.
    #[error("{asked}: built without {feature}: cargo build --features {feature}")]
    LeftOut {
        /// What was asked for.
        asked: &'static str,
        /// The feature that has it.
        feature: &'static str,
    },
    /// A metric refused its input.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A figure could not be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A statistic refused its input.
    #[error(transparent)]
    Statistics(#[from] StatisticsError),
    /// A flag does not fit the method or has a value outside of its range.
    #[error("--{0}")]
    Flag(#[from] OptionError),
    /// A file that cannot be read or written, or does not hold what it should.
    #[error(transparent)]
    Files(#[from] FileError),
    /// A pool was asked for, and nothing could be weighed.
    #[error(
        "--pool: nothing could be weighed, so that there is no pool; the particles are those of a body without a survey"
    )]
    NoPool,
    /// A number that should be finite is not.
    #[error("{what} is not finite: {value}")]
    NotFinite {
        /// What was computed.
        what: String,
        /// What came out.
        value: f64,
    },
    /// A configuration does not say what it has to, or says too much.
    #[error(transparent)]
    Config(#[from] DocumentError),
    /// The file is one that another command takes.
    #[error("{file} seems to be {found}, which `{command}` takes; this command takes {expected}")]
    OtherKind {
        /// The file.
        file: String,
        /// What it seems to be.
        found: &'static str,
        /// The command for it.
        command: &'static str,
        /// What was asked for.
        expected: &'static str,
    },
    /// The parts of a configuration do not fit together.
    #[error("{file}: {field}: {message}")]
    ConfigField {
        /// The file.
        file: String,
        /// The field.
        field: String,
        /// What is wrong with it, with its value.
        message: String,
    },
    /// The output directory is in use by something else.
    #[error("{directory} {occupant}; it was left untouched, choose another --out")]
    DirectoryOccupied {
        /// The directory.
        directory: String,
        /// What it holds.
        occupant: String,
    },
    /// A directory in which nothing was run.
    #[error(
        "{directory} holds no results: a study has its config.toml there, a simulated scene its scene.toml, a reduced-order model its model.safetensors"
    )]
    NothingToReport {
        /// The directory.
        directory: String,
    },
    /// A directory in which a reduced-order model is trained, without the model yet.
    #[error(
        "{directory} holds a training that is not finished: the same `parvi rom train` goes on with it, and reports are of reduced runs"
    )]
    Untrained {
        /// The directory.
        directory: String,
    },
    /// A case of a study gave nothing, which is its result.
    #[error("{}", .0.reason)]
    Failed(Failure),
    /// Ctrl-C.
    #[error("interrupted{hint}")]
    Interrupted {
        /// How to go on.
        hint: String,
    },
    /// A pool of threads could not be started.
    #[error("cannot start {threads} threads: {reason}")]
    Threads {
        /// Their number.
        threads: usize,
        /// What the system said.
        reason: String,
    },
}

impl CommandError {
    /// An operation on a file failed.
    pub fn file(operation: &'static str, path: impl AsRef<Path>, source: std::io::Error) -> Self {
        FileError::system(operation, path, source).into()
    }

    /// A study's own file does not hold what a study writes.
    pub fn unreadable(path: &Path, message: impl ToString) -> Self {
        FileError::unreadable(path, message).into()
    }

    /// Whether the command was interrupted rather than failed.
    pub fn is_interruption(&self) -> bool {
        matches!(
            self,
            Self::Interrupted { .. } | Self::Stopped(_) | Self::Sample(SampleError::Interrupted { .. })
        )
    }
}
