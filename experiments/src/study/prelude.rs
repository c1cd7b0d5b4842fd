//! What every study is written with.

pub use super::attempt::{Failure, attempt};
pub(crate) use super::checks::all_given;
pub use super::checks::{
    ascending, distinct, distinct_names, fitting, not_empty, positive, refusal, targets_without_data, unset,
};
pub use super::definition::{Case, Study, Tools};
pub use super::directory::StudyDirectory;
pub use super::each_once::each_once;
pub use super::report::Report;
pub use super::row::Row;
pub use super::rows::{
    Computed, ENERGY, ENERGY_RATIO, ENERGY_ROOT, EVALUATIONS, NODES_PER_PARTICLE, Quantity, Rows, SECONDS, SLICED,
    SLICED_RATIO, curve,
};
pub use super::sampled::{Sampled, timed};
pub use super::status::Status;
pub use super::yardstick::{Errors, IndependentSets, Yardstick, YardstickOptions};
pub use crate::CommandError;
pub use crate::options::{
    Basis, Bounded, Dimension, MethodName, MethodOptions, MethodSpecification, ParticleCount, Score, StepCount,
    TargetParameters, TargetSpecification,
};
pub use crate::plots::page::{Cell, Header, MISSING, Page, exponent, line, number, percent};
pub use crate::plots::{
    AxisKind, Curve, GuideCurve, LineSeries, MultiplesPanel, MultiplesPlot, exponent_text, multiples,
};
pub use crate::progress::CaseObserver;
pub use serde::Deserialize;
