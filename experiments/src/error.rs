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
    /// A number that should be finite is not.
    #[error("a particle is not finite: {0}")]
    NotFinite(f64),
    /// A configuration does not say what it has to, or says too much.
    #[error(transparent)]
    Config(#[from] DocumentError),
    /// A file that another command takes.
    #[error("{0}")]
    OtherKind(String),
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
    /// What cannot be done as things are: a directory in use by something else, one in which there is nothing to report, a pool of nothing, threads that the system refuses.
    #[error("{0}")]
    Refused(String),
    /// A case of a study gave nothing, which is its result.
    #[error("{}", .0.reason)]
    Failed(Failure),
    /// Ctrl-C, and how to go on.
    #[error("interrupted{0}")]
    Interrupted(String),
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

    /// A directory, or a file in it, is in use: what is there.
    pub fn occupied(path: &Path, occupant: &str) -> Self {
        let path = path.display();
        Self::Refused(format!(
            "{path} {occupant}; it was left untouched, choose another --out"
        ))
    }

    /// Whether the command was interrupted rather than failed.
    pub fn is_interruption(&self) -> bool {
        matches!(
            self,
            Self::Interrupted(_) | Self::Stopped(_) | Self::Sample(SampleError::Interrupted { .. })
        )
    }
}
