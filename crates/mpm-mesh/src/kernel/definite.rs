//! The inverse of four small symmetric matrices side by side, where they are positive definite by a margin.

use mpm_kernels::Lanes;

/// Entries of a symmetric matrix by row and column, in lanes.
pub(super) type LaneMatrix<const D: usize> = [[Lanes; D]; D];

/// A⁻¹ by A = L diag(p) Lᵀ without pivoting, and whether every pivot p_a is above `floor`_a, as a mask. Of `matrix` only the lower triangle is read.
#[inline(always)]
pub(super) fn inverse_of_definite<const D: usize>(
    matrix: &LaneMatrix<D>,
    floor: &[Lanes; D],
) -> (LaneMatrix<D>, Lanes) {
    let mut lower = *matrix; // the strict lower triangle of L, as it is found
    let (mut pivots, mut reciprocals) = ([Lanes::ZERO; D], [Lanes::ZERO; D]);
    let mut definite = Lanes::ZERO.simd_eq(Lanes::ZERO);
    for j in 0..D {
        let mut pivot = matrix[j][j];
        for k in 0..j {
            pivot = (-lower[j][k] * lower[j][k]).mul_add(pivots[k], pivot);
        }
        definite &= pivot.simd_gt(floor[j]);
        (pivots[j], reciprocals[j]) = (pivot, Lanes::splat(1.0) / pivot);
        for i in j + 1..D {
            let mut entry = matrix[i][j];
            for k in 0..j {
                entry = (-lower[i][k] * lower[j][k]).mul_add(pivots[k], entry);
            }
            lower[i][j] = entry * reciprocals[j];
        }
    }
    // K = L⁻¹, unit lower triangular; then A⁻¹ = Kᵀ diag(1/p) K.
    let mut inverse_lower = [[Lanes::ZERO; D]; D];
    for i in 0..D {
        inverse_lower[i][i] = Lanes::splat(1.0);
        for j in 0..i {
            let mut entry = Lanes::ZERO;
            for k in j..i {
                entry = (-lower[i][k]).mul_add(inverse_lower[k][j], entry);
            }
            inverse_lower[i][j] = entry;
        }
    }
    let mut inverse = [[Lanes::ZERO; D]; D];
    for i in 0..D {
        for j in 0..=i {
            let mut entry = Lanes::ZERO;
            for k in i..D {
                entry = (inverse_lower[k][i] * reciprocals[k]).mul_add(inverse_lower[k][j], entry);
            }
            inverse[i][j] = entry;
            inverse[j][i] = entry;
        }
    }
    (inverse, definite)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_tensor::Matrix;

    /// The inverse in lane 2 of four different matrices, where there is one.
    fn inverse<const D: usize>(matrix: Matrix<D>, floor: [f64; D]) -> Option<Matrix<D>> {
        let lane = |value: f64| Lanes::new([1.0, -1.0, value, f64::NAN]);
        let (inverse, definite) = inverse_of_definite(&matrix.0.map(|row| row.map(lane)), &floor.map(Lanes::splat));
        let found = Matrix(inverse.map(|row| row.map(|entry| entry.to_array()[2])));
        (definite.to_bitmask() & 4 != 0).then_some(found)
    }

    #[test]
    fn is_the_inverse() {
        let a = Matrix([[4.0, 1.0, -0.5], [1.0, 3.0, 0.7], [-0.5, 0.7, 2.0]]);
        let found = inverse(a, [0.0; 3]).unwrap();
        assert!((found * a - Matrix::IDENTITY).maximum_norm() < 1e-15);
        assert_eq!(found, found.transpose());
        assert_eq!(inverse(Matrix([[4.0]]), [0.0]), Some(Matrix([[0.25]])));
    }

    #[test]
    fn what_is_not_definite_by_the_margin_has_none() {
        let indefinite = Matrix([[1.0, 2.0], [2.0, 1.0]]);
        assert_eq!(inverse(indefinite, [0.0; 2]), None);
        assert_eq!(inverse(Matrix::<2>::ZERO, [0.0; 2]), None);
        assert_eq!(inverse(Matrix::<2>::IDENTITY, [0.5, 1.5]), None);
        assert_eq!(inverse(Matrix([[f64::NAN]]), [0.0]), None);
    }
}
