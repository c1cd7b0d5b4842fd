//! The public problems of nested sampling whose evidence is known. (Rosenbrock's is [`Rosenbrock`](crate::Rosenbrock), of the same
//! shape and normalised.)

mod eggbox;
mod log_gamma;
mod log_gamma_part;
mod shells;
mod spike_slab;

pub use eggbox::Eggbox;
pub use log_gamma::LogGamma;
pub use shells::GaussianShells;
pub use spike_slab::SpikeSlab;

/// log x/(1 − x), the inverse of the logistic function, for x in (0, 1).
fn logit(x: f64) -> f64 {
    x.ln() - (-x).ln_1p()
}
