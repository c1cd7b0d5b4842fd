use std::path::{Path, PathBuf};

use mpm_core::MpmError;

use crate::SceneError;

/// Why a run ended before its time. What it had written stays: frames, series and the last checkpoint.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// The scene cannot be run.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file cannot be written or read.
    #[error("cannot {operation} {}: {source}", path.display())]
    File {
        /// What was tried.
        operation: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The checkpoint is damaged, or of another scene.
    #[error("{}: {reason}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The mechanics refused a step, for example because a particle was turned inside out or left the domain.
    #[error("step {step} at t = {time}: {}{source}", of_body(body.as_ref()))]
    Step {
        /// Number of the step that failed, counted from 1.
        step: u64,
        /// Time at its start.
        time: f64,
        /// The particle at fault in the order of creation, where there is one.
        particle: Option<usize>,
        /// The name of its body.
        body: Option<String>,
        /// What the mechanics say.
        source: Box<MpmError>,
    },
    /// A line of the time series is not one that a run writes.
    #[error("{}, line {line}: {message}", path.display())]
    Series {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        message: String,
    },
    /// A column of the time series has a value that is no number.
    #[error("step {step} at t = {time}: {column} is {value}: the run has diverged")]
    Diverged {
        /// Steps taken.
        step: u64,
        /// The time.
        time: f64,
        /// The first such column.
        column: String,
        /// Its value.
        value: f64,
    },
    /// A particle has passed the surface of a rigid shape that a barrier should keep it from.
    #[error(
        "step {step} at t = {time}: {}particle {particle} is at distance {distance:?} from a rigid shape of the barrier",
        of_body(body.as_ref())
    )]
    Penetration {
        /// Number of the step that failed, counted from 1.
        step: u64,
        /// Time at its start.
        time: f64,
        /// The particle in the order of creation.
        particle: usize,
        /// The name of its body.
        body: Option<String>,
        /// Its distance, ≤ 0.
        distance: f64,
    },
}

impl SimulationError {
    /// Whether the run ended before its time, and neither its scene nor a file is at fault.
    pub fn is_of_run(&self) -> bool {
        matches!(
            self,
            Self::Step { .. } | Self::Diverged { .. } | Self::Penetration { .. }
        )
    }

    pub(crate) fn file(operation: &'static str, path: &Path, source: impl Into<std::io::Error>) -> Self {
        Self::File {
            operation,
            path: path.to_owned(),
            source: source.into(),
        }
    }

    /// What the mechanics say of a step; `body_of` names the body of a particle.
    pub(super) fn step(step: u64, time: f64, source: MpmError, body_of: impl Fn(usize) -> Option<String>) -> Self {
        if let MpmError::Penetration { particle, distance } = source {
            return Self::Penetration {
                step,
                time,
                particle,
                body: body_of(particle),
                distance,
            };
        }
        let particle = match &source {
            MpmError::PositionOutOfRange { particle, .. }
            | MpmError::OutsideDomain { particle, .. }
            | MpmError::OutsideMesh { particle, .. }
            | MpmError::Deformation { particle, .. }
            | MpmError::WaveSpeed { particle, .. } => Some(*particle),
            MpmError::BodyForceNotFinite { index, .. } => Some(*index),
            _ => None,
        };
        Self::Step {
            step,
            time,
            particle,
            body: particle.and_then(body_of),
            source: Box::new(source),
        }
    }
}

fn of_body(name: Option<&String>) -> String {
    name.map_or(String::new(), |name| format!("bodies.{name}: "))
}
