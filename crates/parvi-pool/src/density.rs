//! The target as the pool sees it: in coordinates of the frame, every evaluation counted, nothing trusted.

use mpm_tensor::vector;
use parvi_targets::{Frame, Target};

/// Log densities beyond this size are taken for no numbers.
const LARGEST: f64 = 1e15;

/// Points that one task evaluates.
const BATCH: usize = 256;

/// log q(z) = log p(μ + L z) + log det L, and its score.
pub(super) struct Density<'a, const D: usize> {
    target: &'a dyn Target<D>,
    frame: &'a Frame<D>,
    log_determinant: f64,
    /// Points at which log p was evaluated.
    pub density_evaluations: u64,
    /// Points at which the score was evaluated.
    pub score_evaluations: u64,
    /// Values that were not finite, or too large, and were taken for log p = −∞ or for no score.
    pub replaced: u64,
}

impl<'a, const D: usize> Density<'a, D> {
    pub fn new(target: &'a dyn Target<D>, frame: &'a Frame<D>) -> Self {
        Self {
            target,
            frame,
            log_determinant: frame.log_determinant(),
            density_evaluations: 0,
            score_evaluations: 0,
            replaced: 0,
        }
    }

    /// log q at all of `zs`; −∞ where it is NaN, +∞ or beyond ±1e15, or where the point itself is not finite.
    pub fn log_densities(&mut self, zs: &[[f64; D]]) -> Vec<f64> {
        let xs: Vec<[f64; D]> = zs.iter().map(|z| self.frame.to_target(z)).collect();
        let mut values = vec![0.0; xs.len()];
        let (target, batches) = (self.target, values.chunks_mut(BATCH).zip(xs.chunks(BATCH)));
        mpm_parallel::each(batches, &|(values, xs): (&mut [f64], &[[f64; D]])| {
            target.log_densities(xs, values);
        });
        self.density_evaluations += zs.len() as u64;
        for (value, x) in values.iter_mut().zip(&xs) {
            let sound = value.abs() < LARGEST && vector::is_finite(x);
            if !sound {
                self.replaced += u64::from(*value != f64::NEG_INFINITY);
            }
            *value = if sound {
                *value + self.log_determinant
            } else {
                f64::NEG_INFINITY
            };
        }
        values
    }

    /// Scores ∇_z log q at all of `zs`; zero where one is not finite.
    pub fn scores(&mut self, zs: &[[f64; D]]) -> Vec<[f64; D]> {
        let xs: Vec<[f64; D]> = zs.iter().map(|z| self.frame.to_target(z)).collect();
        let mut scores = vec![[0.0; D]; xs.len()];
        let (target, batches) = (self.target, scores.chunks_mut(BATCH).zip(xs.chunks(BATCH)));
        mpm_parallel::each(batches, &|(scores, xs): (&mut [[f64; D]], &[[f64; D]])| {
            target.scores(xs, scores);
        });
        self.score_evaluations += zs.len() as u64;
        for score in &mut scores {
            *score = self.frame.pull_back_score(score);
            if vector::maximum_norm(score).is_nan() || vector::maximum_norm(score) > LARGEST {
                self.replaced += 1;
                *score = [0.0; D];
            }
        }
        scores
    }

    /// Evaluations of all kinds.
    pub fn evaluations(&self) -> u64 {
        self.density_evaluations + self.score_evaluations
    }
}
