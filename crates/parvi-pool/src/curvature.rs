//! Local precisions from scores: kernels as narrow as the target is.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use crate::density::Density;
use crate::mixture::Kernel;
use crate::sample::root;

/// Step of the differences of scores, in standard deviations of the local covariance.
const STEP: f64 = 1e-3;

/// A kernel's covariance over that of the local normal approximation.
const INFLATION: f64 = 1.3;

/// Least variance over that of the local covariance: differences of scores take a kink for an infinite curvature.
const NARROWEST: f64 = 0.01;

/// Share of the Newton step by which a centre moves uphill, and the longest move in standard deviations of the local covariance.
const UPHILL: f64 = 0.5;

/// Kernels about these centres with covariances (C⁻¹ + γ [−∇² log p]₊)⁻¹ · 1.3, C the given local covariance, γ the power to which the weights are raised,
/// [·]₊ the positive part in coordinates in which C is I; centres half a Newton step uphill. Takes D + 1 scores per centre.
pub(super) fn sharpened<const D: usize>(
    density: &mut Density<'_, D>,
    centres: &[[f64; D]],
    covariances: &[Matrix<D>],
    gamma: f64,
) -> Vec<Kernel<D>> {
    let factors: Vec<Matrix<D>> = covariances.iter().map(root).collect();
    let mut places = Vec::with_capacity(centres.len() * (D + 1));
    for (centre, factor) in centres.iter().zip(&factors) {
        places.push(*centre);
        for axis in 0..D {
            let column = std::array::from_fn(|row| factor.0[row][axis]);
            places.push(vector::add_scaled(centre, STEP, &column));
        }
    }
    let scores = density.scores(&places);
    let kernel = |((centre, factor), scores): ((&[f64; D], &Matrix<D>), &[[f64; D]])| {
        let here = factor.apply_transposed(&scores[0]);
        let mut hessian = Matrix::<D>::ZERO;
        for axis in 0..D {
            let there = factor.apply_transposed(&scores[axis + 1]);
            for row in 0..D {
                hessian.0[row][axis] = (here[row] - there[row]) / STEP;
            }
        }
        let plain = Kernel {
            centre: *centre,
            factor: *factor,
            share: 1.0,
        };
        let Some(eigen) = SymmetricEigen::new(&hessian.symmetric_part()) else {
            return plain;
        };
        let local = eigen.map(|q| (1.0 / (1.0 + gamma * q.max(0.0))).max(NARROWEST));
        let step = vector::scale(&local.apply(&here), UPHILL * gamma);
        let step = vector::scale(&step, 1.0 / vector::norm(&step).max(1.0));
        let covariance = (*factor * (local * INFLATION) * factor.transpose()).symmetric_part();
        if !(covariance.is_finite() && vector::is_finite(&step)) {
            return plain;
        }
        Kernel {
            centre: vector::add(centre, &factor.apply(&step)),
            factor: root(&covariance),
            share: 1.0,
        }
    };
    centres
        .iter()
        .zip(&factors)
        .zip(scores.chunks(D + 1))
        .map(kernel)
        .collect()
}
