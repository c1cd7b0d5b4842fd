#![doc = include_str!("../README.md")]

mod ais;
mod basis_choice;
mod cached_scores;
pub mod certificate;
mod checkpoint;
mod cholesky;
mod compiled;
mod compiled_bodies;
mod condense;
pub mod defaults;
mod drive;
mod driven;
mod exact;
mod extent;
mod framed_score;
mod free_body;
mod given;
mod grid_density;
mod guard;
mod in_cell;
mod kronecker;
mod method;
mod moment_correction;
mod moving;
mod mpm;
mod mpm_body;
mod node_scores;
#[cfg(feature = "nuts")]
mod nuts;
mod on_mesh;
mod paper;
mod planned_step;
mod point_set_error;
mod polish;
mod remembering_gas;
mod residual;
mod rotation;
mod run;
mod score_grid;
mod smc;
mod start;
mod stein_discrepancy;
mod stein_thinning;
mod stiffness;
mod stretch_limit;
mod support_points;
mod surveyed;
mod svgd;
mod view;
mod watching;

pub use certificate::{Certificate, Expectation, MomentEstimate, Outcome, expectation};
pub use checkpoint::Checkpoint;
pub use compiled::sample;
pub use exact::{independent_draws, sobol_points};
pub use given::GivenParticles;
pub use method::*;
pub use paper::PaperBody;
pub use point_set_error::PointSetError;
pub use residual::{Residual, galerkin_stein_residual};
pub use run::*;
pub use smc::SmcOptions;
pub use stein_thinning::stein_thinning;
pub use support_points::{SupportPoints, support_points};
pub use view::ParticleView;

/// Runs the code of the workspace's README as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct WorkspaceReadme;
