//! What the validation problems are measured against: exact solutions and measurements, one problem per file.

pub mod axis_aligned;
pub mod cantilever;
mod channel;
mod conservation;
pub mod curve;
pub mod cylinder;
mod dam_break;
mod expansion;
pub mod generalized_vortex;
pub mod hertz;
pub mod kirsch;
mod needs;
mod parts;
mod plane_stress;
mod registry;
mod slope_run_out;
mod tilted_cantilever;
mod two_disks;
pub mod vibrating_bar;

#[cfg(test)]
mod dual;

pub use registry::{check, displacement, manufactured, references, validate};

/// u(X, t), as many components as X has.
pub type Displacement = Box<dyn Fn(&[f64], f64) -> Vec<f64>>;
