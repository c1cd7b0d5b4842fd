#![doc = include_str!("../README.md")]

mod basis;
mod body_force;
mod control;
mod counting_sort;
mod diagnosis;
mod error;
mod grid;
mod key_map;
mod largest;
mod lattice;
mod medium;
mod mpm;
mod particles;
mod schedule;
mod step;
mod transfer;

pub use basis::{Basis, UniformBasis};
pub use body_force::{BodyForce, ForceLocation, NoBodyForce};
pub use control::{StepControl, StepReport};
pub use error::MpmError;
pub use grid::SplineGrid;
pub use lattice::SimplexLattice;
pub use medium::{Elastic, Medium, StressImpulse};
pub use mpm::Mpm;
pub use particles::{Masses, Particles};
pub use schedule::{Part, Schedule};
pub use transfer::{
    Apic, Divide, Flip, FlipNode, GridNode, NodeSums, Pic, StencilNodes, Sum, Transfer, VelocityNode, gather,
};
