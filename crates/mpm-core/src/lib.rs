#![doc = include_str!("../README.md")]

mod basis;
mod body_force;
mod control;
mod diagnosis;
mod error;
mod grid;
mod largest;
mod medium;
mod mpm;
mod particles;
mod schedule;
mod step;
mod transfer;

pub use basis::Basis;
pub use body_force::{BodyForce, ForceLocation, NoBodyForce};
pub use control::{StepControl, StepReport};
pub use error::MpmError;
pub use grid::SplineGrid;
pub use medium::{Elastic, Medium, StressImpulse};
pub use mpm::Mpm;
pub use particles::{Masses, Particles};
pub use schedule::Schedule;
pub use transfer::{
    Apic, Divide, Flip, FlipNode, GridNode, Pic, StencilNodes, Transfer, VelocityNode, gather, scatter,
};
