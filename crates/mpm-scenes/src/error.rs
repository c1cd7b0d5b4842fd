//! What can be wrong with a scene.

use std::path::{Path, PathBuf};

use mpm_document::{DocumentError, Place};
use serde::Serialize;

use crate::toml_value;

/// A scene that cannot be run, and why.
#[derive(Debug, thiserror::Error)]
#[error("{}", described(file, fault))]
pub struct SceneError {
    /// The scene's file.
    pub file: PathBuf,
    /// What is wrong with it.
    pub fault: Box<SceneFault>,
}

impl SceneError {
    /// What is wrong, without the line: for a text that no file holds.
    pub fn without_line(&self) -> String {
        let file = self.file.display();
        match &*self.fault {
            SceneFault::Syntax(DocumentError { place, message, .. }) => match place.as_ref().map(Place::field) {
                Some(field) => format!("{file}: {field}: {message}"),
                None => format!("{file}: {message}"),
            },
            fault => format!("{file}: {fault}"),
        }
    }
}

/// What is wrong with a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneFault {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] std::io::Error),
    /// The file is no TOML, has an unknown or missing key, or a value of the wrong type.
    #[error(transparent)]
    Syntax(#[from] DocumentError),
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
    /// A value that is needed is not there.
    #[error("{field} is missing: it must be {expected}")]
    Missing {
        /// The field.
        field: String,
        /// What is needed.
        expected: String,
    },
    /// Two keys of which a table must have one.
    #[error("{table}: one of `{}` and `{}` must be given, {}", keys[0], keys[1], if *both { "not both" } else { "and neither is" })]
    OneOf {
        /// The table, as in `probes[0]`.
        table: String,
        /// The keys.
        keys: [&'static str; 2],
        /// Whether both are there.
        both: bool,
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
    /// A particle lies in no cell of the mesh at the start, nor in its outer layer.
    #[error(
        "bodies.{body}: particle {particle} at {position:?} is outside the mesh: in a hole of it or beyond its boundary, and farther than its outer layer and mesh.reach = {reach:?}"
    )]
    OutsideMesh {
        /// Its body.
        body: String,
        /// Its number in the order of creation.
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// `mesh.reach`.
        reach: f64,
    },
    /// A particle is on the far side of a wall at the start.
    #[error(
        "bodies.{body}: particle {particle} at {position:?} is behind walls[{wall}], the plane through {point:?} that bounds the side which {normal:?} points to"
    )]
    BehindWall {
        /// Its body.
        body: String,
        /// Its number in the order of creation.
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// Number of the wall, counted from 0.
        wall: usize,
        /// A point of the wall.
        point: Vec<f64>,
        /// Its normal into the domain.
        normal: Vec<f64>,
    },
    /// A body begins at or inside something rigid.
    #[error("bodies.{body}: particle {particle} at {position:?} begins inside {table}, {depth:?} below its surface")]
    InsideRigid {
        /// The body.
        body: String,
        /// Number of the particle in the order of creation.
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// What it is in, as in `obstacles[0].shape` and `barrier.shapes[1]`; `barrier.against` is the outside of the mesh.
        table: String,
        /// How deep, ≥ 0.
        depth: f64,
    },
    /// Two held regions have a node in common at the start, near a body, and move it in two ways.
    #[error(
        "held[{first}] and held[{second}] move in two ways and hold the same nodes: they must have no node of {nodes} in common near a body, or the same velocity and rotation"
    )]
    HeldTwice {
        /// The earlier one.
        first: usize,
        /// The later one.
        second: usize,
        /// What nodes there are.
        nodes: String,
    },
    /// The distance between the particles of a body is so short that they cannot be counted.
    #[error(
        "bodies.{body}.{key}: the distance {distance:e} between particles must be so wide that the body has at most {most:e} points"
    )]
    TooManyPoints {
        /// The body.
        body: String,
        /// What sets the distance: `spacing`, or `particles_per_axis` of a cell of the background.
        key: &'static str,
        /// The distance.
        distance: f64,
        /// The most points.
        most: f64,
    },
    /// A background too many.
    #[error("[grid] and [mesh]: must be one of the two, not both")]
    TwoBackgrounds,
    /// The Courant condition asks for so short a step that the end is out of reach.
    #[error(
        "bodies.{body} has the {cause}, with which the Courant condition allows steps of {step:e} at the start; 1e9 of them do not reach time.end = {end:?}"
    )]
    TooManySteps {
        /// The body that asks for it.
        body: String,
        /// What of it does: its speed, or that of its waves.
        cause: StepLimit,
        /// The longest step allowed.
        step: f64,
        /// `time.end`.
        end: f64,
    },
    /// The time step asked for is longer than the Courant condition allows at the start.
    #[error("time.step = {step:?}: must be at most {limit:?}, the Courant number {courant:?} times h / (c + max |v|)")]
    TimeStep {
        /// `time.step`.
        step: f64,
        /// The longest step allowed.
        limit: f64,
        /// `time.courant`.
        courant: f64,
    },
}

/// What makes the time step of a body short.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StepLimit {
    /// Its velocity, of this size.
    #[error("speed {0:e}")]
    Speed(f64),
    /// Its stiffness over its density: the speed of its waves.
    #[error("wave speed {0:e}, by its stiffness and density")]
    WaveSpeed(f64),
    /// Its viscosity over its density.
    #[error("highest viscosity over density")]
    Viscosity,
}

impl SceneFault {
    /// A [`Value`](Self::Value), which is written as in the file; [`Missing`](Self::Missing) for `None`.
    pub fn value(field: impl Into<String>, value: impl Serialize, expected: impl Into<String>) -> Self {
        match toml_value::text(value) {
            Some(value) => Self::Value {
                field: field.into(),
                value,
                expected: expected.into(),
            },
            None => Self::missing(field, expected),
        }
    }

    /// A [`OneOf`](Self::OneOf).
    pub(crate) fn one_of(table: impl Into<String>, keys: [&'static str; 2], both: bool) -> Self {
        Self::OneOf {
            table: table.into(),
            keys,
            both,
        }
    }

    /// A [`Missing`](Self::Missing).
    pub fn missing(field: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Missing {
            field: field.into(),
            expected: expected.into(),
        }
    }
}

/// The fault with its file, once.
fn described(file: &Path, fault: &SceneFault) -> String {
    match fault {
        SceneFault::Syntax(error) => error.to_string(),
        fault => format!("{}: {fault}", file.display()),
    }
}
