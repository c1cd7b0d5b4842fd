//! What stands for the target when all weights are put together: a signed measure.

use std::ops::Range;

use mpm_tensor::vector;
use parvi_targets::Frame;

use crate::estimate::{Estimate, error_between};
use crate::fold::Fold;
use crate::weights::{tempered, top};

/// Free draws of a last proposal, per point wanted: more on lines and planes, where particles come so near to a measure that its own noise shows.
const fn free(dimension: usize) -> usize {
    if dimension <= 2 { 16 } else { 8 }
}

/// Control variates are worth their draws where they take this much of the variance away.
const WORTH: f64 = 0.2;

/// Points with weights, some of them negative, that sum to one: the integral of f against the target is Σ c f(y).
///
/// In every fold the last proposal q serves as a control variate (A. Owen, Y. Zhou, *Safe and effective importance sampling*, J. Am. Stat. Assoc. 95, 2000, §2):
/// ∫ p f / Z ≈ Σ_i (p(x_i)/Z − β q(x_i)) / S(x_i) f(x_i) + β/K Σ_k f(y_k), S(x) = Σ_t n_t q_t(x), with K draws y of q, which cost no evaluation.
/// Z = Ẑ / (1 + β (Σ_i q(x_i)/S(x_i) − 1)) makes the weights sum to one; β in [0, 1] makes Σ c_i² r_i ([`variance`](Self::variance)) least. The nearer q is to p, the smaller the c_i are.
#[derive(Clone, Debug, Default)]
pub struct Measure<const D: usize> {
    /// Where the mass is.
    pub points: Vec<[f64; D]>,
    /// c; they sum to one.
    pub weights: Vec<f64>,
    /// Whether the target was evaluated there; else the point is a free draw, of a proposal whose density is known.
    pub evaluated: Vec<bool>,
    /// Σ c² r over the points that were evaluated, r = (1 + |z|²/D)/2 at z of [`frame`](Self::frame): what 1/n is for n independent draws.
    pub variance: f64,
    /// Where the points of every independent part end.
    ends: Vec<usize>,
}

impl<const D: usize> Measure<D> {
    /// Of points with weights that sum to one. Points without a weight, and weights without a point, are left out.
    pub fn new(mut points: Vec<[f64; D]>, mut weights: Vec<f64>) -> Self {
        points.truncate(weights.len());
        weights.truncate(points.len());
        let mut measure = Self {
            evaluated: vec![true; points.len()],
            ends: vec![points.len()],
            points,
            weights,
            variance: 0.0,
        };
        let reaches = measure.reaches(&measure.points);
        measure.variance = measure.weights.iter().zip(&reaches).map(|(c, r)| c * c * r).sum();
        measure
    }

    /// Of what one fold knows, in the frame's coordinates, and the evidence that goes with it; for `wanted` points to be condensed from it.
    pub(crate) fn of_fold(fold: &Fold<D>, wanted: usize, seed: u64) -> Option<(f64, Self)> {
        let logs = fold.log_weights();
        let top = top(&logs);
        let mut weights = tempered(&logs, 1.0);
        let sum: f64 = weights.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        weights.iter_mut().for_each(|w| *w /= sum);
        let evidence = top + sum.ln();
        let plain = Self::new(fold.positions.clone(), weights);
        let Some(core) = fold.core() else {
            return Some((evidence, plain));
        };
        let control = fold.weights_of(&core);
        let reach = plain.reaches(&plain.points);
        let dot = |a: &[f64], b: &[f64]| -> f64 {
            let products = a.iter().zip(b).zip(&reach);
            products.map(|((a, b), r)| a * b * r).sum()
        };
        let (product, own) = (dot(&plain.weights, &control), dot(&control, &control));
        let beta = (product / own).clamp(0.0, 1.0);
        let correction = 1.0 + beta * (control.iter().sum::<f64>() - 1.0);
        let weights: Vec<f64> = plain
            .weights
            .iter()
            .zip(&control)
            .map(|(w, q)| w * correction - beta * q)
            .collect();
        let draws = core.draws(free(D) * wanted, seed);
        let of_draws = plain.reaches(&draws).iter().sum::<f64>() * (beta / draws.len() as f64).powi(2);
        let variance = dot(&weights, &weights);
        let gains = variance + of_draws < (1.0 - WORTH) * plain.variance;
        if !gains {
            return Some((evidence, plain));
        }
        let mut measure = Self {
            weights,
            variance,
            ..plain
        };
        measure.weights.extend(vec![beta / draws.len() as f64; draws.len()]);
        measure.evaluated.extend(vec![false; draws.len()]);
        measure.points.extend(draws);
        measure.ends = vec![measure.points.len()];
        Some((evidence - correction.ln(), measure))
    }

    /// How much every point means to second moments: (1 + |z|²/D)/2, z its coordinates in the frame.
    fn reaches(&self, points: &[[f64; D]]) -> Vec<f64> {
        let frame = self.frame();
        let of = |y: &[f64; D]| 0.5 + 0.5 * vector::norm_squared(&frame.to_reference(y)) / D as f64;
        points.iter().map(of).collect()
    }

    /// The coordinates in which this has mean zero and covariance I: distances in them are the same whatever the target's axes and units are. Where the
    /// covariance is singular they have standard deviation one on every axis, and where there is no such thing either they are the target's own.
    pub fn frame(&self) -> Frame<D> {
        let by_axes = |_| {
            let (mean, deviation) = self.mean_and_deviation();
            Frame::from_scales(mean, deviation.map(|s| if s > 0.0 { s } else { 1.0 }))
        };
        let frame = Frame::of_points(&self.points, Some(&self.weights)).or_else(by_axes);
        frame.unwrap_or_else(|_| Frame::identity())
    }

    /// Adds `share` times another measure to `1 − share` times this one.
    pub(crate) fn mixed(mut self, share: f64, other: Self) -> Self {
        self.variance = (1.0 - share).powi(2) * self.variance + share * share * other.variance;
        self.weights.iter_mut().for_each(|c| *c *= 1.0 - share);
        self.weights.extend(other.weights.iter().map(|c| share * c));
        self.ends.extend(other.ends.iter().map(|end| self.points.len() + end));
        self.points.extend(other.points);
        self.evaluated.extend(other.evaluated);
        self
    }

    /// The points of every part that was drawn and weighed by itself: how far these are apart says how far all are from the target.
    pub(crate) fn parts(&self) -> impl Iterator<Item = Range<usize>> {
        // The points are anyone's to change: what was added belongs to the last part.
        let count = self.points.len();
        let (_, inner) = self.ends.split_last().unwrap_or((&0, &[]));
        let begins = std::iter::once(0).chain(inner.iter().copied());
        let ends = inner.iter().copied().chain([count]);
        begins
            .zip(ends)
            .map(move |(begin, end)| begin.min(count)..end.min(count))
    }

    /// The mass that is nearer to a particle than to any other one in coordinates of the [`frame`](Self::frame), for every particle; none negative, and their
    /// sum is one; equal ones where there is no mass.
    pub fn shares(&self, particles: &[[f64; D]]) -> Vec<f64> {
        let frame = self.frame();
        let particles: Vec<[f64; D]> = particles.iter().map(|x| frame.to_reference(x)).collect();
        let nearest = |y: &[f64; D]| {
            let y = frame.to_reference(y);
            let distances = particles.iter().map(|x| vector::distance_squared(x, &y));
            distances
                .enumerate()
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(index, _)| index)
        };
        let owners = mpm_parallel::collect(self.points.len(), 256, &|index| nearest(&self.points[index]));
        let mut shares = vec![0.0; particles.len()];
        for (owner, c) in owners.into_iter().zip(&self.weights) {
            if let Some(owner) = owner {
                shares[owner] += c;
            }
        }
        let total: f64 = shares.iter().map(|share: &f64| share.max(0.0)).sum();
        if total > 0.0 {
            shares.iter().map(|share| share.max(0.0) / total).collect()
        } else {
            vec![1.0 / shares.len() as f64; shares.len()]
        }
    }

    /// Σ c f(y).
    pub fn integral(&self, f: impl Fn(&[f64; D]) -> f64) -> f64 {
        let weighted = self.points.iter().zip(&self.weights).filter(|(_, c)| **c != 0.0);
        weighted.map(|(y, c)| c * f(y)).sum()
    }

    /// Σ c f(y) with its standard error: the root of Σ c² (f − f̄)² over the points that were evaluated and, for the free draws of every fold, what separates eight blocks of them, which is little of a smooth f; or, if that is more, what the independent parts that the measure is made of
    /// are apart. Free draws come from kernels with longer tails than the target's: of a function that grows faster than
    /// a power of y they may know nothing ([`Pool::expectation`](crate::Pool::expectation) sees to that).
    pub fn expectation(&self, f: impl Fn(&[f64; D]) -> f64) -> Estimate {
        let terms = self.terms(f);
        let (estimate, _) = Estimate::of_terms(&terms);
        self.spread(estimate, &terms)
    }

    /// (c, f, whether the target was evaluated there) of every point; f is not asked where c is zero.
    pub(crate) fn terms(&self, f: impl Fn(&[f64; D]) -> f64) -> Vec<(f64, f64, bool)> {
        let points = self.points.iter().zip(&self.weights).zip(&self.evaluated);
        let term = |((y, &c), &evaluated)| (c, if c == 0.0 { 0.0 } else { f(y) }, evaluated);
        points.map(term).collect()
    }

    /// The estimate with an error no smaller than what the parts are apart.
    pub(crate) fn spread(&self, estimate: Estimate, terms: &[(f64, f64, bool)]) -> Estimate {
        let sums = |part: Range<usize>| {
            let part = terms.get(part).unwrap_or(&[]).iter();
            part.fold([0.0; 2], |[share, deviation], (c, f, _)| {
                [share + c, deviation + c * (f - estimate.value)]
            })
        };
        let parts: Vec<[f64; 2]> = self.parts().map(sums).collect();
        Estimate {
            standard_error: estimate.standard_error.max(error_between(&parts)),
            ..estimate
        }
    }

    /// Mean and standard deviation of every coordinate.
    pub fn mean_and_deviation(&self) -> ([f64; D], [f64; D]) {
        let mean: [f64; D] = std::array::from_fn(|a| self.integral(|y| y[a]));
        let variance = |a: usize| self.integral(|y| (y[a] - mean[a]).powi(2));
        (mean, std::array::from_fn(|a| variance(a).max(0.0).sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_the_masses_nearest_to_the_particles() {
        let measure = Measure::new(vec![[0.0], [1.0], [4.0]], vec![0.5, 0.2, 0.3]);
        assert_eq!(measure.shares(&[[0.4], [5.0]]), [0.7, 0.3]);
        // The second axis is a thousandth as wide as the first.
        let measure = Measure::new(
            vec![[0.0, 0.0], [0.0, 1e-3], [1.0, 0.0], [1.0, 1e-3]],
            vec![0.1, 0.2, 0.3, 0.4],
        );
        let shares = measure.shares(&[[0.4, 0.0], [0.6, 1e-3]]);
        assert!((shares[0] - 0.4).abs() < 1e-15, "{shares:?}");
        assert_eq!(
            Measure::new(vec![[1.0]; 3], vec![0.0; 2]).shares(&[[0.0], [1.0]]),
            [0.5, 0.5]
        );
    }
}
