#![doc = include_str!("../README.md")]
//!
//! ## Where to begin
//!
//! With [`MethodSpecification`] and [`TargetSpecification`], which files hold, or with [`MethodOptions`] and [`TargetParameters`], which a command line holds. Both lead to what the sampler takes:
//! [`MethodOptions::method`] to a [`parvi::Method`], [`TargetSpecification::build`] to a target of the catalogue. What cannot be is an [`OptionError`].

mod bounded;
mod checked_when_read;
mod law;
mod limit;
mod material_options;
mod material_table;
mod method_options;
mod method_specification;
mod methods;
mod option_error;
mod option_rules;
mod option_values;
mod seed;
mod target_specification;
mod words;
mod words_or_files;

pub use bounded::{Bounded, Dimension, EvaluationCount, ParticleCount, RoundCount, StepCount, WarmUp};
use checked_when_read::checked_when_read;
pub use law::Material;
use law::{Given, Parameter};
pub use limit::Limit;
pub use material_table::MaterialTable;
pub use method_options::MethodOptions;
pub use method_specification::MethodSpecification;
pub use methods::{MethodName, is_among, owners};
pub use option_error::OptionError;
pub use option_values::{
    AlphaSchedule, Basis, CondensationName, Correction, Draws, FrameName, MonitorName, NonFinite, PoolChoice, Score,
    Switch, Transfer,
};
pub use parvi_plot::results::Value;
pub use seed::seed;
pub use target_specification::{TargetParameters, TargetSpecification};
