//! The singular value decomposition.

use crate::plane_rotation::{PlaneRotation, sweep};
use crate::scaling::reciprocal_scale;
use crate::{Matrix, vector};

/// Squared length below which a column of a matrix with largest entry in [1, 2) counts as zero.
const NULL_COLUMN: f64 = 1e-280;

/// The singular value decomposition A = U diag(σ) Vᵀ, singular values descending.
///
/// By the one-sided Jacobi method (Hestenes 1958; Demmel & Veselić, *Jacobi's method is more accurate than QR*, SIAM J.
/// Matrix Anal. Appl. 13, 1992): the columns of A are rotated in pairs until they are orthogonal. U and V are orthogonal
/// to rounding for clustered, repeated and zero singular values too; a singular value below 1e-140 of the largest may be
/// returned as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularValues<const D: usize> {
    /// The orthogonal matrix U; column k is the left singular vector of `values[k]`.
    pub left: Matrix<D>,
    /// The singular values σ_0 ≥ σ_1 ≥ … ≥ 0, in the unit of A.
    pub values: [f64; D],
    /// The orthogonal matrix V (not its transpose); column k is the right singular vector of `values[k]`.
    pub right: Matrix<D>,
}

impl<const D: usize> SingularValues<D> {
    /// Decomposes `matrix`; `None` if an entry is not finite.
    pub fn new(matrix: &Matrix<D>) -> Option<Self> {
        let factor = reciprocal_scale(matrix)?;
        // Rows of these are the columns of A V and of V.
        let mut images = (*matrix * factor).transpose();
        let mut right = Matrix::<D>::IDENTITY;
        sweep::<D>(|p, q| orthogonalise(&mut images, &mut right, p, q));
        let lengths = images.0.map(|image| vector::norm(&image));
        let mut order: [usize; D] = std::array::from_fn(|k| k);
        order.sort_by(|&k, &l| lengths[l].total_cmp(&lengths[k]));
        let mut left = Matrix::<D>::ZERO;
        for k in 0..D {
            let (image, length) = (&images.0[order[k]], lengths[order[k]]);
            left.0[k] = if length * length < NULL_COLUMN {
                complete(&left, k)
            } else {
                image.map(|component| component / length)
            };
        }
        Some(Self {
            left: left.transpose(),
            values: std::array::from_fn(|k| lengths[order[k]] / factor),
            right: Matrix::from_fn(|i, k| right.0[order[k]][i]),
        })
    }
}

/// Rotates the images p and q until they are orthogonal; false if they already were.
fn orthogonalise<const D: usize>(images: &mut Matrix<D>, right: &mut Matrix<D>, p: usize, q: usize) -> bool {
    let first = vector::norm_squared(&images.0[p]);
    let second = vector::norm_squared(&images.0[q]);
    let product = vector::dot(&images.0[p], &images.0[q]);
    let negligible = f64::EPSILON * (D as f64).sqrt() * first.sqrt() * second.sqrt();
    if first.min(second) < NULL_COLUMN || product.abs() <= negligible {
        return false;
    }
    let rotation = PlaneRotation::diagonalising(first, product, second);
    rotation.apply_to_rows(images, p, q);
    rotation.apply_to_rows(right, p, q);
    true
}

/// A unit vector orthogonal to the first `count` rows of `basis`, which are orthonormal.
///
/// The axis farthest from their span, orthogonalised twice (Kahan's "twice is enough").
fn complete<const D: usize>(basis: &Matrix<D>, count: usize) -> [f64; D] {
    let mut best = [0.0; D];
    for axis in 0..D {
        let mut candidate = [0.0; D];
        candidate[axis] = 1.0;
        for _ in 0..2 {
            for row in &basis.0[..count] {
                let overlap = vector::dot(&candidate, row);
                vector::accumulate(&mut candidate, -overlap, row);
            }
        }
        if vector::norm_squared(&candidate) > vector::norm_squared(&best) {
            best = candidate;
        }
    }
    let length = vector::norm(&best);
    best.map(|component| component / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn singular_values_descend() {
        let decomposition = SingularValues::new(&Matrix([[0.0, 3.0], [-5.0, 0.0]])).expect("finite entries");
        assert_eq!(decomposition.values, [5.0, 3.0]);
    }

    #[test]
    fn the_null_space_is_completed() {
        let zero = SingularValues::new(&Matrix::<4>::ZERO).expect("finite entries");
        assert_eq!(zero.values, [0.0; 4]);
        assert_eq!(zero.left * zero.left.transpose(), Matrix::IDENTITY);
        assert_eq!(zero.right, Matrix::IDENTITY);
    }

    #[test]
    fn non_finite_entries_have_none() {
        assert_eq!(SingularValues::new(&Matrix([[1.0, f64::NAN], [0.0, 1.0]])), None);
        assert_eq!(SingularValues::new(&Matrix([[f64::INFINITY]])), None);
    }
}
