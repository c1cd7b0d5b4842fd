//! Points with weights, their moments, and draws of equal weight from them.

use mpm_tensor::{Matrix, vector};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::Moments;

/// Points with weights that sum to one.
#[derive(Clone, Debug, PartialEq)]
pub struct WeightedDraws<const D: usize> {
    /// The points.
    pub points: Vec<[f64; D]>,
    /// Their weights, as many.
    pub weights: Vec<f64>,
}

impl<const D: usize> WeightedDraws<D> {
    /// Mean and covariance Σ w (x − m)(x − m)ᵀ / Σ w.
    pub fn moments(&self) -> Moments<D> {
        moments_of(&self.points, &self.weights)
    }

    /// (Σ w)² / Σ w².
    pub fn effective_sample_size(&self) -> f64 {
        let sum: f64 = self.weights.iter().sum();
        let square: f64 = self.weights.iter().map(|weight| weight * weight).sum();
        sum * sum / square
    }

    /// `count` points of equal weight by systematic resampling: a point of weight w appears ⌊count·w⌋ or ⌈count·w⌉
    /// times. The same seed gives the same points. Empty if there are no points.
    ///
    /// Source: J. Carpenter, P. Clifford, P. Fearnhead, *IEE Proceedings Radar, Sonar and Navigation* 146 (1999) 2–7.
    pub fn resampled(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
        let offset: f64 = ChaCha8Rng::seed_from_u64(seed).random();
        let total: f64 = self.weights.iter().sum();
        let mut pairs = self.points.iter().zip(&self.weights);
        let Some((mut point, mut reached)) = pairs.next().map(|(point, weight)| (point, *weight)) else {
            return Vec::new();
        };
        (0..count)
            .map(|index| {
                let goal = (index as f64 + offset) / count as f64 * total;
                while reached < goal {
                    match pairs.next() {
                        Some((next, weight)) => (point, reached) = (next, reached + weight),
                        None => break,
                    }
                }
                *point
            })
            .collect()
    }
}

/// Mean and covariance of weighted points; the weights need not sum to one.
pub(crate) fn moments_of<const D: usize>(points: &[[f64; D]], weights: &[f64]) -> Moments<D> {
    let total: f64 = weights.iter().sum();
    let mut mean = [0.0; D];
    for (point, weight) in points.iter().zip(weights) {
        vector::accumulate(&mut mean, weight / total, point);
    }
    let mut covariance = Matrix([[0.0; D]; D]);
    for (point, weight) in points.iter().zip(weights) {
        let offset = vector::subtract(point, &mean);
        for i in 0..D {
            vector::accumulate(&mut covariance.0[i], weight / total * offset[i], &offset);
        }
    }
    Moments { mean, covariance }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_and_resampling_follow_the_weights() {
        let draws = WeightedDraws {
            points: vec![[0.0], [1.0], [2.0]],
            weights: vec![0.25, 0.25, 0.5],
        };
        let moments = draws.moments();
        assert_eq!(moments.mean, [1.25]);
        assert!((moments.covariance.0[0][0] - (0.25 + 0.5 * 4.0 - 1.25 * 1.25)).abs() < 1e-15);
        assert!((draws.effective_sample_size() - 1.0 / 0.375).abs() < 1e-14);
        for seed in 0..20 {
            let mut points = draws.resampled(8, seed);
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            assert_eq!(points, [[0.0], [0.0], [1.0], [1.0], [2.0], [2.0], [2.0], [2.0]]);
        }
        assert!(
            WeightedDraws::<2> {
                points: vec![],
                weights: vec![]
            }
            .resampled(3, 0)
            .is_empty()
        );
        assert!(draws.resampled(0, 0).is_empty());
    }
}
