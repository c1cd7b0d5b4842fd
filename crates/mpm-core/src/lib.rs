#![doc = include_str!("../README.md")]

mod basis;
mod body_force;
mod boundary;
mod cell_sort;
pub mod conformance;
mod contact;
mod control;
mod counting_sort;
mod deformation;
mod diagnosis;
mod energy_budget;
mod error;
mod friction;
mod grid;
mod grid_to_particles;
mod key_map;
mod largest;
mod lattice;
mod medium;
mod mpm;
mod particles;
mod particles_to_grid;
mod product_grid;
mod schedule;
mod step;
mod stress_update;
mod transfer;
mod velocity_filter;
mod volume_averaging;

pub use basis::{Basis, Member, NO_NODE, UniformBasis};
pub use body_force::{BodyForce, ForceLocation, NoBodyForce, Sites};
pub use boundary::{
    Amplitude, Boundaries, Boundary, Contact, Extents, GridMotion, HalfSpace, HeldNode, HeldSurface, ImageNode,
    Loading, NoBoundary, NodeForces, ON_A_SURFACE, Obstacle, Plane, PrescribedVelocity, SignedDistance, VirtualStress,
};
pub use cell_sort::CellSort;
pub use contact::{ContactPoint, ContactPotential};
pub use control::{StepControl, StepReport};
pub use energy_budget::EnergyBudget;
pub use error::MpmError;
pub use friction::Friction;
pub use grid::SplineGrid;
pub use lattice::SimplexLattice;
pub use medium::{Continuum, DeformsLast, Medium, StressImpulse, StressWork};
pub use mpm::Mpm;
pub use particles::{Masses, Particles};
pub use product_grid::{ProductGrid, SplineDegree};
pub use schedule::{Part, Schedule};
pub use stress_update::StressUpdate;
pub use transfer::{
    AffineFlip, Apic, Divide, Flip, FlipNode, GridNode, Mls, Moments, NodeSums, Pic, StencilNodes, Sum, Transfer,
    VelocityNode, gather,
};
pub use velocity_filter::VelocityFilter;
pub use volume_averaging::VolumeAveraging;
