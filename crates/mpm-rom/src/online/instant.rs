//! The instant of a step.

use super::Inverted;
use crate::manifold::Evaluation;

/// What a quadrature is told of the instant.
pub(super) struct Instant<'a, const D: usize> {
    pub latent: &'a [f64],
    pub rates: &'a [f64],
    pub step: u64,
    /// X_p of the sample points, and the map there.
    pub reference: &'a [[f64; D]],
    pub samples: &'a Evaluation<D>,
    /// Their numbers, where they are others in every step.
    pub redrawn: Option<&'a [u32]>,
    /// What happens at J ≤ 0.
    pub inverted: Inverted,
}
