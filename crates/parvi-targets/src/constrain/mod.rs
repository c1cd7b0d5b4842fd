//! Constrained parameters: maps from unconstrained coordinates, which a sampler moves, to a user's own.

mod builder;
mod constrained_target;
mod constraints;
mod correlation;
mod correlation_cholesky;
mod free;
mod half_line;
mod interval;
mod matrices;
mod numbers;
mod ordered;
mod partial_correlations;
mod simplex;
mod transform;

pub use builder::ConstraintsBuilder;
pub use constrained_target::ConstrainedTarget;
pub use constraints::Constraints;
pub use matrices::{correlation_matrix, lower_triangle};
pub use transform::{OutsideSupport, Transform};
