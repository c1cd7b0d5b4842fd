//! What can be wrong with a scene.

use std::path::PathBuf;

/// A scene that cannot be run, and why.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", file.display())]
pub struct SceneError {
    /// The scene's file.
    pub file: PathBuf,
    /// What is wrong with it.
    pub fault: Box<SceneFault>,
}

/// What is wrong with a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneFault {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] std::io::Error),
    /// The file is no TOML, has an unknown or missing key, or a value of the wrong type.
    #[error("line {line}{}: {message}", in_field(field))]
    Syntax {
        /// The line, counted from 1.
        line: usize,
        /// The field at that line with the table it stands in, as in `materials.steel.density`; empty where there is none.
        field: String,
        /// What the parser says; it names unknown and missing keys.
        message: String,
    },
    /// A value is outside its range, or does not fit the rest of the scene.
    #[error("{field} = {value}: must be {expected}")]
    Value {
        /// The field, as in `materials.steel.poisson_ratio`.
        field: String,
        /// Its value.
        value: String,
        /// What is allowed.
        expected: String,
    },
    /// A body has no particles: its shape is empty or smaller than the distance between particles.
    #[error("bodies.{body}.shape holds no particle")]
    EmptyBody {
        /// The body.
        body: String,
    },
    /// A particle of one body lies inside another.
    #[error("bodies.{first} and bodies.{second} overlap at {position:?}")]
    Overlap {
        /// The body that the other one reaches into.
        first: String,
        /// The body with the particle.
        second: String,
        /// Where the particle is.
        position: Vec<f64>,
    },
    /// A particle lies outside the domain at the start.
    #[error("bodies.{body}: particle {particle} at {position:?} is outside the domain {lower:?} to {upper:?}")]
    OutsideDomain {
        /// Its body.
        body: String,
        /// Its number in the order of creation.
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// `domain.lower`.
        lower: Vec<f64>,
        /// `domain.upper`.
        upper: Vec<f64>,
    },
    /// The time step asked for is longer than the Courant condition allows at the start.
    #[error("time.step = {step}: must be at most {limit}, the Courant number {courant} times h / (c + max |v|)")]
    TimeStep {
        /// `time.step`.
        step: f64,
        /// The longest step allowed.
        limit: f64,
        /// `time.courant`.
        courant: f64,
    },
}

impl SceneFault {
    /// A [`Value`](Self::Value).
    pub fn value(field: impl Into<String>, value: impl std::fmt::Debug, expected: impl Into<String>) -> Self {
        Self::Value {
            field: field.into(),
            value: format!("{value:?}"),
            expected: expected.into(),
        }
    }
}

fn in_field(field: &str) -> String {
    if field.is_empty() {
        String::new()
    } else {
        format!(", {field}")
    }
}
