//! placeholder

mod basis;
mod body_force;
mod control;
mod error;
mod grid;
mod largest;
mod medium;
mod particles;
mod schedule;
mod step;
mod transfer;

pub use basis::Basis;
pub use body_force::{BodyForce, NoBodyForce};
pub use control::{StepControl, StepReport};
pub use error::MpmError;
pub use grid::SplineGrid;
pub use medium::{Elastic, Medium, StressImpulse};
pub use particles::{Masses, Particles};
pub use schedule::Schedule;
pub use step::Mpm;
pub use transfer::{Apic, Flip, FlipNode, GridNode, Pic, StencilNodes, Transfer, VelocityNode, gather, scatter};
