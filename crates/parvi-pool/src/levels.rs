//! Exploring by levels: points spread evenly over where the density is above a level.

use mpm_tensor::Matrix;

use crate::fold::Fold;
use crate::sample::Sample;
use crate::weights::tempered;

/// Effective size that the weights of a level set have, at most, and as a share of all points.
const SIZE: f64 = 300.0;
const SIZE_SHARE: f64 = 0.05;

/// `count` points from the uniform law over {log p > ℓ}, ℓ the highest level above `lowest` at which their weights 1/q are of a sufficient effective size,
/// or `lowest` if none is: a few points far out, where q is small, outweigh all others, and every lower level has more of them.
///
/// A level set sees modes of unequal mass, and the far ends of a ridge, alike: J. Skilling, *Nested sampling for general Bayesian computation*, Bayesian Anal. 1, 2006.
pub(super) fn level_sample<const D: usize>(fold: &Fold<D>, lowest: f64, count: usize, offset: f64) -> Sample<D> {
    let mut order: Vec<usize> = (0..fold.positions.len())
        .filter(|&i| fold.log_densities[i] >= lowest)
        .collect();
    order.sort_by(|&a, &b| fold.log_densities[b].total_cmp(&fold.log_densities[a]).then(a.cmp(&b)));
    let logs = fold.log_weights();
    let inverse: Vec<f64> = order.iter().map(|&i| logs[i] - fold.log_densities[i]).collect();
    let mut weights = tempered(&inverse, 1.0);
    let wanted = SIZE.min(SIZE_SHARE * logs.len() as f64);
    let (mut sum, mut squares) = (0.0, 0.0);
    let sufficient = weights.iter().position(|w| {
        sum += w;
        squares += w * w;
        sum * sum >= wanted * squares
    });
    let high = sufficient.map_or(order.len(), |last| last + 1);
    weights.truncate(high);
    let chosen = &order[..high];
    let level = Sample {
        points: chosen.iter().map(|&i| fold.positions[i]).collect(),
        weights,
        logs: chosen.iter().map(|&i| fold.log_densities[i]).collect(),
        precisions: vec![Some(Matrix::ZERO); high],
    };
    level.resampled(count, offset)
}
