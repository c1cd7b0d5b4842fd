//! What the validation problems are measured against: exact solutions and measurements, one problem per file.

pub mod axis_aligned;
pub mod cantilever;
pub mod channel;
pub mod conservation;
pub mod convergence;
pub mod curve;
pub mod cylinder;
pub mod dam_break;
pub mod expansion;
pub mod generalized_vortex;
mod needs;
mod parts;
mod registry;
pub mod slope_run_out;
pub mod tilted_cantilever;
pub mod two_disks;
pub mod vibrating_bar;

#[cfg(test)]
mod dual;

pub use registry::{MANUFACTURED, REFERENCES, check, displacement, manufactured, validate};

/// u(X, t), as many components as X has.
pub type Displacement = Box<dyn Fn(&[f64], f64) -> Vec<f64>>;
