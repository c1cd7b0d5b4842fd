//! The inverse of a small symmetric matrix, where it is positive definite by a margin.

use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

/// A⁻¹ by A = L diag(p) Lᵀ without pivoting; `None` unless every pivot p_a is above `floor`_a.
#[inline(always)]
pub(super) fn inverse_of_definite<const D: usize>(matrix: &Matrix<D>, floor: &[f64; D]) -> Option<Matrix<D>> {
    let mut lower = matrix.0; // the strict lower triangle of L, as it is found
    let (mut pivots, mut reciprocals) = ([0.0; D], [0.0; D]);
    let mut definite = true;
    for j in 0..D {
        let mut pivot = matrix.0[j][j];
        for k in 0..j {
            pivot = multiply_add(-lower[j][k] * lower[j][k], pivots[k], pivot);
        }
        definite &= pivot > floor[j];
        (pivots[j], reciprocals[j]) = (pivot, 1.0 / pivot);
        for i in j + 1..D {
            let mut entry = matrix.0[i][j];
            for k in 0..j {
                entry = multiply_add(-lower[i][k] * lower[j][k], pivots[k], entry);
            }
            lower[i][j] = entry * reciprocals[j];
        }
    }
    if !definite {
        return None;
    }
    // K = L⁻¹, unit lower triangular; then A⁻¹ = Kᵀ diag(1/p) K.
    let mut inverse_lower = Matrix::<D>::IDENTITY.0;
    for i in 0..D {
        for j in 0..i {
            let mut entry = 0.0;
            for k in j..i {
                entry = multiply_add(-lower[i][k], inverse_lower[k][j], entry);
            }
            inverse_lower[i][j] = entry;
        }
    }
    let mut inverse = Matrix::ZERO;
    for i in 0..D {
        for j in 0..=i {
            let mut entry = 0.0;
            for k in i..D {
                entry = multiply_add(inverse_lower[k][i] * reciprocals[k], inverse_lower[k][j], entry);
            }
            inverse.0[i][j] = entry;
            inverse.0[j][i] = entry;
        }
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_inverse() {
        let a = Matrix([[4.0, 1.0, -0.5], [1.0, 3.0, 0.7], [-0.5, 0.7, 2.0]]);
        let inverse = inverse_of_definite(&a, &[0.0; 3]).unwrap();
        assert!((inverse * a - Matrix::IDENTITY).maximum_norm() < 1e-15);
        assert_eq!(inverse, inverse.transpose());
        assert_eq!(inverse_of_definite(&Matrix([[4.0]]), &[0.0]), Some(Matrix([[0.25]])));
    }

    #[test]
    fn what_is_not_definite_by_the_margin_has_none() {
        let indefinite = Matrix([[1.0, 2.0], [2.0, 1.0]]);
        assert_eq!(inverse_of_definite(&indefinite, &[0.0; 2]), None);
        assert_eq!(inverse_of_definite(&Matrix::<2>::ZERO, &[0.0; 2]), None);
        assert_eq!(inverse_of_definite(&Matrix::<2>::IDENTITY, &[0.5, 1.5]), None);
        assert_eq!(inverse_of_definite(&Matrix([[f64::NAN]]), &[0.0]), None);
    }
}
