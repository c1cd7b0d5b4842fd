//! Exploring by levels: points spread evenly over where the density is above a level.

use mpm_tensor::Matrix;

use crate::fold::Fold;
use crate::sample::Sample;
use crate::weights::{effective_size, tempered};

/// Effective size that the weights of a level set have, at most, and as a share of all points.
const SIZE: f64 = 300.0;
const SIZE_SHARE: f64 = 0.05;

/// `count` points from the uniform law over {log p > ℓ}, ℓ the highest level at which their weights 1/q are of a sufficient effective size.
///
/// A level set sees modes of unequal mass, and the far ends of a ridge, alike: J. Skilling, *Nested sampling for general Bayesian computation*, Bayesian Anal. 1, 2006.
pub(super) fn level_sample<const D: usize>(fold: &Fold<D>, count: usize, offset: f64) -> Sample<D> {
    let logs = fold.log_weights();
    let inverse: Vec<f64> = logs.iter().zip(&fold.log_densities).map(|(w, p)| w - p).collect();
    let mut order: Vec<usize> = (0..logs.len()).filter(|&i| fold.log_densities[i].is_finite()).collect();
    order.sort_by(|&a, &b| fold.log_densities[b].total_cmp(&fold.log_densities[a]).then(a.cmp(&b)));
    let weights_of = |above: usize| {
        let logs: Vec<f64> = order[..above].iter().map(|&i| inverse[i]).collect();
        tempered(&logs, 1.0)
    };
    let wanted = SIZE.min(SIZE_SHARE * logs.len() as f64);
    let (mut low, mut high) = (0, order.len());
    while high - low > 1 {
        let middle = (low + high) / 2;
        if effective_size(&weights_of(middle)) >= wanted {
            high = middle
        } else {
            low = middle
        }
    }
    let chosen = &order[..high];
    let level = Sample {
        points: chosen.iter().map(|&i| fold.positions[i]).collect(),
        weights: weights_of(high),
        logs: chosen.iter().map(|&i| fold.log_densities[i]).collect(),
        precisions: vec![Some(Matrix::ZERO); high],
    };
    level.resampled(count, offset)
}
