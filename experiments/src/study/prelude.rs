//! What every study is written with.

pub use std::fmt::Display;

pub use super::attempt::{Attempt, Failure, attempt};
pub(crate) use super::checks::all_given;
pub use super::checks::{
    ascending, distinct, distinct_names, finite, fitting, holds, interval, not_empty, positive, refusal, unset,
};
pub use super::definition::{Case, Report, Study, Tools};
pub use super::derived::{ENERGY, SECONDS, WALL, completed, stencil};
pub use super::directory::StudyDirectory;
pub use super::places::{Place, places};
pub use super::row::{RunRow, RunRows};
pub use super::row_file;
pub use super::sampled::{Sampled, timed};
pub use super::status::Status;
pub use super::yardstick::{Coordinates, Errors, IndependentSets, Yardstick, YardstickOptions};
pub use crate::CommandError;
pub use crate::plots::page::{Cell, Line, MISSING, Page, each, number, percent};
pub use crate::plots::results::{Row, Rows};
pub use crate::plots::{GuideCurve, LineSeries, MultiplesPanel, MultiplesPlot, exponent_text, multiples};
pub use crate::progress::Bar;
pub use parvi_options::{
    Basis, Bounded, Dimension, MethodName, MethodOptions, MethodSpecification, ParticleCount, Score, StepCount,
    TargetSpecification,
};
pub use serde::Deserialize;
