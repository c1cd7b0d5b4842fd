//! The target as the pool sees it: in coordinates of the frame, every evaluation counted, nothing trusted.

use std::collections::HashMap;

use mpm_tensor::{Matrix, vector};
use parvi_targets::{Frame, Target};

use crate::options::PoolError;

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
    /// Points at which log p was finite and not too large.
    pub finite: u64,
    /// Log densities of finite points that were NaN, +∞ or too large: what mass is there, nobody knows.
    pub undefined: u64,
    /// Every value of the target in the order of evaluation: what an earlier process left, then what this one adds.
    pub tape: Vec<f64>,
    /// Values of the tape that have been used.
    read: usize,
    /// −∇² log p where it is known, by the bits of the point.
    precisions: HashMap<[u64; D], Matrix<D>>,
}

impl<'a, const D: usize> Density<'a, D> {
    pub fn new(target: &'a dyn Target<D>, frame: &'a Frame<D>, tape: Vec<f64>) -> Self {
        Self {
            target,
            frame,
            log_determinant: frame.log_determinant(),
            density_evaluations: 0,
            score_evaluations: 0,
            replaced: 0,
            finite: 0,
            undefined: 0,
            tape,
            read: 0,
            precisions: HashMap::new(),
        }
    }

    /// log q at all of `zs`; −∞ where it is NaN, +∞ or beyond ±1e15, or where the point itself is not finite.
    pub fn log_densities(&mut self, zs: &[[f64; D]]) -> Vec<f64> {
        let xs: Vec<[f64; D]> = zs.iter().map(|z| self.frame.to_target(z)).collect();
        let mut values = self.played(xs.len(), 1);
        let known = values.len();
        values.resize(xs.len(), 0.0);
        let batches = values[known..].chunks_mut(BATCH).zip(xs[known..].chunks(BATCH));
        let target = self.target;
        mpm_parallel::each(batches, &|(values, xs): (&mut [f64], &[[f64; D]])| {
            target.log_densities(xs, values);
        });
        self.record(&values[known..]);
        self.density_evaluations += zs.len() as u64;
        for (value, x) in values.iter_mut().zip(&xs) {
            let sound = value.abs() < LARGEST && vector::is_finite(x);
            self.finite += u64::from(sound);
            if !sound {
                self.replaced += u64::from(*value != f64::NEG_INFINITY);
                self.undefined += u64::from(vector::is_finite(x) && (value.is_nan() || *value > 0.0));
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
        let played = self.played(xs.len(), D);
        let mut scores: Vec<[f64; D]> = played
            .chunks_exact(D)
            .map(|s| std::array::from_fn(|axis| s[axis]))
            .collect();
        let known = scores.len();
        scores.resize(xs.len(), [0.0; D]);
        let batches = scores[known..].chunks_mut(BATCH).zip(xs[known..].chunks(BATCH));
        let target = self.target;
        mpm_parallel::each(batches, &|(scores, xs): (&mut [[f64; D]], &[[f64; D]])| {
            target.scores(xs, scores);
        });
        self.record(scores[known..].as_flattened());
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

    /// The next values of the tape, in whole points of `width` values, at most `count` points.
    fn played(&mut self, count: usize, width: usize) -> Vec<f64> {
        let left = (self.tape.len() - self.read) / width;
        let start = self.read;
        self.read += width * count.min(left);
        if left < count {
            // The end of the tape: what is left of it belongs to no whole point.
            self.tape.truncate(self.read);
        }
        self.tape[start..self.read].to_vec()
    }

    /// Appends values that the tape did not hold.
    fn record(&mut self, values: &[f64]) {
        self.tape.extend_from_slice(values);
        self.read += values.len();
    }

    /// The points at which −∇² log p is not known.
    pub fn without_precision(&self, points: &[[f64; D]]) -> Vec<usize> {
        let is_unknown = |&i: &usize| !self.precisions.contains_key(&points[i].map(f64::to_bits));
        (0..points.len()).filter(is_unknown).collect()
    }

    /// Remembers −∇² log p at a point.
    pub fn keep_precision(&mut self, point: &[f64; D], precision: Matrix<D>) {
        self.precisions.insert(point.map(f64::to_bits), precision);
    }

    /// −∇² log p as remembered; zero where it is not known.
    pub fn precision(&self, point: &[f64; D]) -> Matrix<D> {
        self.precisions
            .get(&point.map(f64::to_bits))
            .copied()
            .unwrap_or(Matrix::ZERO)
    }

    /// The error that too few points have a finite log density.
    pub fn nowhere_finite(&self) -> PoolError {
        PoolError::NowhereFinite {
            points: self.density_evaluations,
            finite: self.finite,
            undefined: self.undefined,
        }
    }

    /// Evaluations of all kinds.
    pub fn evaluations(&self) -> u64 {
        self.density_evaluations + self.score_evaluations
    }
}
