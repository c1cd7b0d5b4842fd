//! Local precisions from scores, and what they leave of a covariance.

use mpm_tensor::{Matrix, SymmetricEigen};

use crate::density::Density;
use crate::sample::root;

/// Step of the differences of scores, in standard deviations of the local covariance.
const STEP: f64 = 1e-3;

/// Least variance over that of the given covariance: differences of scores take a kink for an infinite curvature.
const NARROWEST: f64 = 1e-4;

/// −∇² log p at these points, from D + 1 scores each; steps go along the columns of the roots of the local covariances. A point asked for the second time costs nothing.
pub(super) fn precisions<const D: usize>(
    density: &mut Density<'_, D>,
    points: &[[f64; D]],
    covariances: &[Matrix<D>],
) -> Vec<Matrix<D>> {
    let unknown: Vec<usize> = density.without_precision(points);
    let factors: Vec<Matrix<D>> = unknown.iter().map(|&i| root(&covariances[i]) * STEP).collect();
    let mut places = Vec::with_capacity(unknown.len() * (D + 1));
    for (&i, factor) in unknown.iter().zip(&factors) {
        places.push(points[i]);
        for axis in 0..D {
            places.push(std::array::from_fn(|row| points[i][row] + factor.0[row][axis]));
        }
    }
    let scores = density.scores(&places);
    for ((&i, factor), scores) in unknown.iter().zip(&factors).zip(scores.chunks(D + 1)) {
        // Columns −H L, hence H = −(H L) L⁻¹.
        let along = Matrix::from_fn(|row, axis| scores[0][row] - scores[axis + 1][row]);
        let precision = factor
            .lower_triangular_inverse()
            .map(|inverse| (along * inverse).symmetric_part());
        density.keep_precision(&points[i], precision.filter(Matrix::is_finite).unwrap_or(Matrix::ZERO));
    }
    points.iter().map(|point| density.precision(point)).collect()
}

/// (C⁻¹ + H₊)⁻¹, where H₊ is the positive part of H in coordinates in which C is I.
pub(super) fn sharpened<const D: usize>(covariance: &Matrix<D>, precision: &Matrix<D>) -> Matrix<D> {
    let factor = root(covariance);
    let local = (factor.transpose() * *precision * factor).symmetric_part();
    let Some(eigen) = SymmetricEigen::new(&local) else {
        return *covariance;
    };
    let left = eigen.map(|q| (1.0 / (1.0 + q.max(0.0))).max(NARROWEST));
    let sharpened = (factor * left * factor.transpose()).symmetric_part();
    if sharpened.is_finite() { sharpened } else { *covariance }
}
