//! The target as the survey sees it: in the coordinates of the given frame, point by point, every evaluation counted.

use parvi_targets::{Frame, Target};

/// A point with log p and the score there, in frame coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Valued<const D: usize> {
    pub point: [f64; D],
    pub log_density: f64,
    pub score: [f64; D],
}

/// log q(z) = log p(μ + L z) and its score, up to the constant log det L.
pub(super) struct Density<'a, const D: usize> {
    target: &'a dyn Target<D>,
    frame: &'a Frame<D>,
    /// Points evaluated so far, whether for log p, for the score or for both.
    pub evaluations: u64,
}

impl<'a, const D: usize> Density<'a, D> {
    pub fn new(target: &'a dyn Target<D>, frame: &'a Frame<D>) -> Self {
        Self {
            target,
            frame,
            evaluations: 0,
        }
    }

    /// log q(z); −∞ where it is NaN.
    pub fn log_density(&mut self, z: &[f64; D]) -> f64 {
        self.evaluations += 1;
        let value = self.target.log_density(&self.frame.to_target(z));
        if value.is_nan() { f64::NEG_INFINITY } else { value }
    }

    /// log q and score at z, `None` where either is not finite.
    pub fn value(&mut self, z: &[f64; D]) -> Option<Valued<D>> {
        let log_density = self.log_density(z);
        let score = self.frame.pull_back_score(&self.target.score(&self.frame.to_target(z)));
        let finite = log_density.is_finite() && score.iter().all(|c| c.is_finite());
        finite.then_some(Valued {
            point: *z,
            log_density,
            score,
        })
    }
}
