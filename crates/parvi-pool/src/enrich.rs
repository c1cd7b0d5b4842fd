//! Samples enriched by moves: where few draws hit, a walk from those that did is the cheaper way to learn the shape of the target.

use mpm_tensor::{Matrix, vector};
use parvi_targets::normal_quantile;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::curvature::sharpened;
use crate::density::Density;
use crate::fold::Fold;
use crate::lanes::packed;
use crate::neighbours::local_covariances;
use crate::sample::{Sample, root};

/// Acceptance that the length of the steps aims at: A. Gelman, W. R. Gilks, G. O. Roberts, *Weak convergence and optimal scaling of random walk Metropolis
/// algorithms*, Ann. Appl. Probab. 7, 1997.
const ACCEPTANCE: f64 = 0.3;

/// Exponent by which the length answers to an acceptance of one or none.
const ANSWER: f64 = 1.5;

/// Walks under the law p^γ q^{1−γ} of the tempered weights, q the density of the fold that they come from, one from every point of `sample`; every state
/// visited joins the sample.
///
/// Metropolis steps x + ε L z, with L the root of the covariance of a walk's neighbours, kept for the whole walk, and ε = 2.4 ε'/√D, ε' common to all walks.
/// Walks begin under their law, so that none needs time to forget where it began.
pub(super) fn enriched<const D: usize>(
    mut sample: Sample<D>,
    source: &[&Fold<D>],
    gamma: f64,
    moves: usize,
    density: &mut Density<'_, D>,
    rng: &mut ChaCha8Rng,
) -> Sample<D> {
    let mut points = sample.points.clone();
    let weights = sample.weights.clone();
    let mut logs = sample.logs.clone();
    let families = sample.families.clone();
    let covariances = local_covariances(&sample, &points, 4 * D);
    let factors: Vec<Matrix<D>> = covariances
        .iter()
        .zip(&sample.precisions)
        .map(|(covariance, precision)| root(&sharpened(covariance, &precision.unwrap_or(Matrix::ZERO))))
        .collect();
    let mut length = 2.4 / (D as f64).sqrt();
    for _ in 0..moves {
        let trials: Vec<[f64; D]> = points
            .iter()
            .zip(&factors)
            .map(|(x, factor)| {
                let z = std::array::from_fn(|_| normal_quantile(rng.random_range(1e-9..1.0)));
                vector::add_scaled(x, length, &factor.apply(&z))
            })
            .collect();
        let values = density.log_densities(&trials);
        let trial_logs = tempered_logs(&trials, &values, source, gamma);
        let mut accepted = 0;
        for (walk, trial) in trials.into_iter().enumerate() {
            let u: f64 = rng.random();
            if u.ln() < trial_logs[walk] - logs[walk] {
                points[walk] = trial;
                logs[walk] = trial_logs[walk];
                accepted += 1;
            }
        }
        length *= (ANSWER * (accepted as f64 / points.len().max(1) as f64 - ACCEPTANCE)).exp();
        sample.points.extend_from_slice(&points);
        sample.weights.extend_from_slice(&weights);
        sample.logs.extend_from_slice(&logs);
        sample.families.extend_from_slice(&families);
        sample.precisions.extend(families.iter().map(|_| None));
    }
    sample
}

/// γ log p + (1 − γ) log q at points where log p is known, q the mixture of the folds.
pub(super) fn tempered_logs<const D: usize>(
    points: &[[f64; D]],
    values: &[f64],
    source: &[&Fold<D>],
    gamma: f64,
) -> Vec<f64> {
    if gamma >= 1.0 {
        return values.to_vec();
    }
    let groups = packed(points);
    let folds = 1.0 / source.len() as f64;
    let mut densities = vec![[0.0; crate::lanes::LANES]; groups.len()];
    for fold in source {
        fold.add_density(&groups, folds / fold.positions.len() as f64, &mut densities);
    }
    let pairs = values.iter().zip(densities.as_flattened());
    pairs
        .map(|(log, q)| gamma * log + (1.0 - gamma) * q.max(f64::MIN_POSITIVE).ln())
        .collect()
}
