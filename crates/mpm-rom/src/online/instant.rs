//! The instant of a step.

use super::Inverted;

/// What a quadrature is told of the instant.
pub(super) struct Instant<'a, const D: usize> {
    pub latent: &'a [f64],
    pub rates: &'a [f64],
    pub step: u64,
    /// x_p of the sample points.
    pub samples: &'a [[f64; D]],
    /// What happens at J ≤ 0.
    pub inverted: Inverted,
}
