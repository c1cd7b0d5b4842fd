//! The target as the pool sees it: in coordinates of the frame, every evaluation counted, nothing trusted.

use std::collections::HashMap;

use mpm_tensor::{Matrix, vector};
use parvi_targets::Frame;

use crate::options::PoolError;
use crate::source::Source;

/// Log densities beyond this size are taken for no numbers: their rounding alone is a tenth.
const LARGEST: f64 = 1e15;

/// What a stopped source is said to have spent: more than anybody may.
const ALL: u64 = u64::MAX / 4;

/// log q(z) = log p(μ + L z) + log det L, and its score.
pub(super) struct Density<'a, const D: usize> {
    pub source: Source<'a, D>,
    /// Of its coordinates.
    pub frame: &'a Frame<D>,
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
    /// Log densities of finite points that were numbers below −1e15.
    beyond: u64,
    /// −∇² log p where it is known, by the bits of the point.
    precisions: HashMap<[u64; D], Matrix<D>>,
}

impl<'a, const D: usize> Density<'a, D> {
    pub fn new(source: Source<'a, D>, frame: &'a Frame<D>) -> Self {
        Self {
            source,
            frame,
            log_determinant: frame.log_determinant(),
            density_evaluations: 0,
            score_evaluations: 0,
            replaced: 0,
            finite: 0,
            undefined: 0,
            beyond: 0,
            precisions: HashMap::new(),
        }
    }

    /// Of a target, without an observer.
    #[cfg(test)]
    pub fn of(target: &'a dyn parvi_targets::Target<D>, frame: &'a Frame<D>) -> Self {
        Self::new(Source::new(target, Vec::new(), None), frame)
    }

    /// log q at all of `zs`; −∞ where it is NaN, +∞ or beyond ±1e15, or where the point itself is not finite.
    pub fn log_densities(&mut self, zs: &[[f64; D]]) -> Vec<f64> {
        let xs: Vec<[f64; D]> = zs.iter().map(|z| self.frame.to_target(z)).collect();
        let mut values = self.source.log_densities(&xs);
        self.density_evaluations += zs.len() as u64;
        for (value, x) in values.iter_mut().zip(&xs) {
            let sound = value.abs() < LARGEST && vector::is_finite(x);
            self.finite += u64::from(sound);
            if !sound {
                self.replaced += u64::from(*value != f64::NEG_INFINITY);
                let is_place = vector::is_finite(x);
                self.undefined += u64::from(is_place && (value.is_nan() || *value > 0.0));
                self.beyond += u64::from(is_place && value.is_finite() && *value < 0.0);
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
        let mut scores = self.source.scores(&xs);
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
            beyond: self.beyond,
            scores: self.score_evaluations,
        }
    }

    /// Evaluations of all kinds; all that there may be where nothing is evaluated any more.
    pub fn evaluations(&self) -> u64 {
        if self.source.is_stopped() {
            ALL
        } else {
            self.density_evaluations + self.score_evaluations
        }
    }
}
