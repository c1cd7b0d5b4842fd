//! A reduced run beside a full-order one, at the points of the latter.

use mpm_tensor::vector;

use crate::deformation_map::MaterialPoints;
use crate::manifold::{Evaluation, Wanted};
use crate::online::ReducedModel;
use crate::position_error::PositionError;
use crate::snapshots::Frame;

/// The points of a full-order run as a reduced model sees them, and how far they have been apart so far.
pub(super) struct Comparison<const D: usize> {
    pub points: MaterialPoints<D>,
    evaluation: Evaluation<D>,
    /// Of all frames but the first, where both runs start.
    pub total: PositionError,
}

impl<const D: usize> Comparison<D> {
    pub fn new(reduced: &ReducedModel<'_, D>, reference: &[[f64; D]]) -> Self {
        Self {
            points: reduced.prepare(reference),
            evaluation: Evaluation::default(),
            total: PositionError::default(),
        }
    }

    /// The error of a frame, in per cent. The first one, where both runs start, has no part in the error of the run.
    pub fn add(&mut self, reduced: &ReducedModel<'_, D>, frame: &Frame<D>, first: bool) -> f64 {
        reduced.evaluate(&self.points, Wanted::default(), &mut self.evaluation);
        let mut error = PositionError::default();
        error.add(&self.evaluation.positions, &frame.positions);
        if !first {
            self.total.merge(&error);
        }
        error.percent().unwrap_or(0.0)
    }

    /// Distances |g − φ| in m of the points of the frame that was added last.
    pub fn distances(&self, frame: &Frame<D>) -> Vec<f64> {
        let pairs = self.evaluation.positions.iter().zip(&frame.positions);
        pairs.map(|(x, expected)| vector::distance(x, expected)).collect()
    }
}
