#![doc = include_str!("../README.md")]

mod ais;
mod cached_scores;
pub mod certificate;
mod checkpoint;
mod cholesky;
mod compiled;
mod condense;
pub mod defaults;
mod drive;
mod driven;
mod exact;
mod extent;
mod free_body;
mod given;
mod guard;
mod kronecker;
mod method;
mod moment_correction;
mod mpm;
mod mpm_body;
#[cfg(feature = "nuts")]
mod nuts;
#[cfg(feature = "mesh")]
mod on_mesh;
mod paper;
mod point_set_error;
mod polish;
mod rotation;
mod run;
mod score_check;
mod score_grid;
mod smc;
mod start;
mod stein_discrepancy;
mod stein_thinning;
mod strays;
mod support_points;
mod surveyed;
mod svgd;
mod tails;
mod task;
mod view;
mod watching;

pub use certificate::{Certificate, EstimatedMoment, Expectation, MomentEstimate, Outcome, expectation};
pub use checkpoint::Checkpoint;
pub use compiled::sample;
pub use exact::{independent_draws, sobol_points};
pub use given::GivenParticles;
pub use method::*;
pub use parvi_body::{BasisChoice, NonFiniteScores, Residual, ScoreLocation, TransferChoice, galerkin_stein_residual};
pub use point_set_error::PointSetError;
pub use run::*;
pub use smc::SmcOptions;
pub use stein_thinning::stein_thinning;
pub use support_points::{SupportPoints, support_points};
pub use view::ParticleView;
