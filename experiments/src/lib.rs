//! The `parvi` command: sampling, studies, reports and plots.
//!
//! [`command`] parses the command line; `sampling` runs a sampler on a target of run-time dimension; `study` runs lists of cases into a directory and
//! reports on them with [`plots`] and [`statistics`]. What flags and configurations share is the crate `parvi-options`, files of particles and pictures of a run are `parvi-files`.

pub mod command;
mod console;
mod diagnostics;
mod dispatch;
mod error;
mod interrupt;
mod machine;
#[cfg(feature = "mechanics")]
mod mechanics;
mod progress;
mod provenance;
mod sampling;
mod study;

pub use error::CommandError;
pub use parvi_plot::{self as plots, statistics};

/// Runs the code of the workspace's README as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct WorkspaceReadme;
