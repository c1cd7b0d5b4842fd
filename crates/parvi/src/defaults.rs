//! Every default of the calibrated sampler, in one place, in the units of the frame.

use crate::BasisChoice;

/// Steps.
pub fn steps() -> usize {
    100
}

/// Spacing h of a tensor-product grid for M particles in D dimensions.
pub fn spacing<const D: usize>(basis: BasisChoice, particles: usize) -> f64 {
    let _ = (basis, particles);
    1.0
}

/// Δt for spacing h.
pub fn time_step(spacing: f64) -> f64 {
    (0.6 * spacing).min(0.6)
}

/// Friction γ.
pub const FRICTION: f64 = 1.5;
