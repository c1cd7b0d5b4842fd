//! What the loop leaves of a body.

use crate::Samples;

/// Particles at the end of their steps.
#[derive(Clone, Debug)]
pub(crate) struct Driven<const D: usize> {
    /// The result.
    pub samples: Samples<D>,
    /// Positions in frame coordinates, in the same order.
    pub positions: Vec<[f64; D]>,
    /// Scores in frame coordinates at these.
    pub scores: Vec<[f64; D]>,
    /// What mean and spread changed by over the last tenth of the steps, in standard deviations.
    pub drift: f64,
    /// ½ Σ m |v|² (total mass 1).
    pub kinetic_energy: f64,
}

impl<const D: usize> Driven<D> {
    /// Particles that have not moved, without scores, in coordinates of the frame and of the target.
    pub fn at_rest(positions: Vec<[f64; D]>, seen: Vec<[f64; D]>) -> Self {
        Self {
            samples: Samples {
                positions: seen,
                ..Samples::default()
            },
            positions,
            scores: Vec::new(),
            drift: 0.0,
            kinetic_energy: 0.0,
        }
    }
}
