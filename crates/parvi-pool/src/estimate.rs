//! The finished pool: everything evaluated with its weights, and what follows from them.

use mpm_tensor::Matrix;
use parvi_targets::Frame;

use crate::condense::condense;
use crate::density::Density;
use crate::fold::Fold;
use crate::mixture::Mixture;
use crate::referee::Verdict;
use crate::sample::moments;
use crate::weights::effective_size;

/// An expectation with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The weighted mean.
    pub value: f64,
    /// √(Σ w² (f − f̄)²) / Σ w.
    pub standard_error: f64,
}

/// Every point at which log p was evaluated, with weights.
#[derive(Clone, Debug)]
pub struct Pool<const D: usize> {
    /// Positions in the target's coordinates.
    pub positions: Vec<[f64; D]>,
    /// log p there; −∞ where it is not a number to count with.
    pub log_densities: Vec<f64>,
    /// Weights that sum to one.
    pub weights: Vec<f64>,
    /// log Z from all points.
    pub log_evidence: f64,
    /// What fresh points of the frozen proposal say.
    pub verdict: Verdict,
    /// The frozen proposal, in frame coordinates.
    pub proposal: Option<Mixture<D>>,
    /// Points at which log p was evaluated.
    pub density_evaluations: u64,
    /// Points at which the score was evaluated.
    pub score_evaluations: u64,
    /// Values that were not finite or too large.
    pub values_replaced: u64,
}

impl<const D: usize> Pool<D> {
    /// Joins the folds: each estimates Z by itself; they count by their effective sizes.
    pub(super) fn new(
        folds: [Fold<D>; 2],
        fresh: Fold<D>,
        covered: &[bool],
        frame: &Frame<D>,
        density: &Density<'_, D>,
    ) -> Self {
        let fresh_logs = fresh.log_weights();
        let points = fresh.positions.len() as f64;
        let verdict = Verdict::of(
            &fresh_logs.iter().map(|l| l + points.ln()).collect::<Vec<f64>>(),
            covered,
        );
        let proposal = fresh.rounds.first().map(|(_, proposal)| proposal.clone());
        let [first, second] = folds;
        let all = [first, second, fresh];
        let sizes: Vec<f64> = all.iter().map(Fold::effective_size).collect();
        let total: f64 = sizes.iter().sum();
        let (mut positions, mut log_densities, mut logs) = (Vec::new(), Vec::new(), Vec::new());
        for (fold, size) in all.into_iter().zip(&sizes) {
            let share = (size / total).ln();
            logs.extend(fold.log_weights().iter().map(|l| l + share));
            positions.extend(fold.positions.iter().map(|z| frame.to_target(z)));
            log_densities.extend(fold.log_densities.iter().map(|l| l - frame.log_determinant()));
        }
        let mut weights = crate::weights::tempered(&logs, 1.0);
        let top = logs
            .iter()
            .copied()
            .filter(|l| l.is_finite())
            .fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|w| *w /= sum);
        Self {
            positions,
            log_densities,
            weights,
            log_evidence: top + sum.ln(),
            verdict,
            proposal,
            density_evaluations: density.density_evaluations,
            score_evaluations: density.score_evaluations,
            values_replaced: density.replaced,
        }
    }

    /// Kish's effective size of the weights.
    pub fn effective_size(&self) -> f64 {
        effective_size(&self.weights)
    }

    /// Mean and covariance.
    pub fn moments(&self) -> ([f64; D], Matrix<D>) {
        moments(&self.positions, &self.weights)
    }

    /// E\[f\] under the target; points without weight are not asked.
    pub fn expectation(&self, f: impl Fn(&[f64; D]) -> f64) -> Estimate {
        let weighted = || self.positions.iter().zip(&self.weights).filter(|(_, w)| **w > 0.0);
        let values: Vec<f64> = weighted().map(|(x, _)| f(x)).collect();
        let value: f64 = weighted().zip(&values).map(|((_, w), f)| w * f).sum();
        let variance: f64 = weighted()
            .zip(&values)
            .map(|((_, w), f)| (w * (f - value)).powi(2))
            .sum();
        Estimate {
            value,
            standard_error: variance.sqrt(),
        }
    }

    /// The quantile of one coordinate; NaN for an axis that is none.
    pub fn quantile(&self, axis: usize, probability: f64) -> f64 {
        if axis >= D {
            return f64::NAN;
        }
        let mut order: Vec<usize> = (0..self.positions.len()).filter(|&i| self.weights[i] > 0.0).collect();
        order.sort_by(|&a, &b| self.positions[a][axis].total_cmp(&self.positions[b][axis]));
        let mut sum = 0.0;
        for &index in &order {
            sum += self.weights[index];
            if sum >= probability {
                return self.positions[index][axis];
            }
        }
        order.last().map_or(f64::NAN, |&index| self.positions[index][axis])
    }

    /// M particles of equal mass: support points of the weighted pool.
    pub fn condense(&self, count: usize) -> Vec<[f64; D]> {
        condense(&self.positions, &self.weights, count, 0.5)
    }
}
