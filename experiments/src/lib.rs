//! The `parvi` command: sampling, studies, reports and plots.
//!
//! [`command`] parses the command line; [`options`] holds what flags and configurations share; [`sampling`] runs a sampler
//! on a target of run-time dimension; [`output`] writes particles; [`study`] runs lists of cases into a directory and
//! reports on them with [`plots`] and [`statistics`].

pub mod command;
mod console;
mod diagnostics;
mod dispatch;
mod error;
mod interrupt;
mod machine;
#[cfg(feature = "mechanics")]
mod mechanics;
pub mod options;
pub mod output;
pub mod pictures;
mod progress;
pub mod sampling;
pub mod study;

pub use error::CommandError;
pub use parvi_plot::{self as plots, statistics};
