//! The logarithmic strain of a deformation gradient.

use mpm_tensor::{Matrix, SingularValues, SymmetricEigen, vector};

use crate::stretch::left_cauchy_green;

/// Above this largest entry of F − I, or below this squared stretch, the logarithm is taken of the stretch itself.
const FAR_FROM_REST: f64 = 0.5;

/// Largest ‖b − I‖ for the power series, whose terms then fall by 1/80 or faster.
const SERIES_RANGE: f64 = 0.2;

/// What rounding may take from a deviator's norm, of that of the whole: the square is a difference.
const ROUNDING: f64 = 1e-7;

/// ε = ½ ln b, b = F Fᵀ: the spatial logarithmic (Hencky) strain, exactly symmetric.
///
/// Near rest, from F = I + H the matrix b − I = H + Hᵀ + H Hᵀ is formed without the cancellation of F Fᵀ − I, so that
/// small strains keep their digits. In the plane b has the eigenvalues b̄ ± r, b̄ = ½ tr b, and
///
/// ε = ½ ln J I + ½ artanh(r / b̄) (b − b̄ I) / r,
///
/// in which nothing cancels for equal stretches. Beyond the plane, for ‖b − I‖ ≤ 0.2, by the series
///
/// ε = artanh Z = Z + Z³/3 + Z⁵/5 + …, Z = (b − I) (b + I)⁻¹ (Higham, *Functions of Matrices*, ch. 11),
///
/// three times faster than the principal axes, which serve otherwise: by Jacobi's method on b − I, or on F where a
/// stretch is so small that b has lost it. `None` unless F is finite with 0 < J < ∞, or if b overflows.
#[inline]
pub(crate) fn log_strain<const D: usize>(F: &Matrix<D>) -> Option<Matrix<D>> {
    let J = F.determinant();
    if !(J > 0.0 && J < f64::INFINITY) {
        return None;
    }
    match D {
        2 => Some(plane(F, J)),
        _ => {
            let squared_strain = strains_from_rest(F).1;
            let size = squared_strain.frobenius_norm();
            if size <= SERIES_RANGE {
                series(&squared_strain)
            } else {
                by_jacobi(F, &squared_strain)
            }
        }
    }
}

/// A number that ‖dev ε‖ is not above, without the logarithm: ½ ‖dev b‖ / (1 − ‖b − I‖); infinite for ‖b − I‖ ≥ 1.
///
/// ‖dev ln b‖ = min_c ‖ln b − c I‖ ≤ ‖ln b − ln m I‖ with m the mean of b's eigenvalues, and the logarithm's slope is at most that at the smallest of them, which is above 1 − ‖b − I‖.
#[inline]
pub(crate) fn deviator_bound<const D: usize>(F: &Matrix<D>) -> f64 {
    let squared_strain = strains_from_rest(F).1;
    let (size, trace) = (squared_strain.contract(&squared_strain), squared_strain.trace());
    let deviator = (size - trace * trace / D as f64).max(0.0).sqrt() + ROUNDING * size.sqrt();
    let least = 1.0 - size.sqrt();
    if least > 0.0 {
        0.5 * deviator / least
    } else {
        f64::INFINITY
    }
}

/// F − I and b − I.
#[inline]
fn strains_from_rest<const D: usize>(F: &Matrix<D>) -> (Matrix<D>, Matrix<D>) {
    let H = *F - Matrix::IDENTITY;
    let squared = Matrix::from_fn(|i, j| (H.0[i][j] + H.0[j][i]) + vector::dot(&H.0[i], &H.0[j]));
    (H, squared)
}

/// artanh Z from b − I.
#[inline]
fn series<const D: usize>(squared_strain: &Matrix<D>) -> Option<Matrix<D>> {
    let Z = *squared_strain * inverse_near_rest(&(*squared_strain + Matrix::IDENTITY * 2.0))?;
    let square = Z * Z;
    // ‖Z^(2k+1)‖ ≤ bound ‖Z‖.
    let ratio = square.frobenius_norm();
    let (mut power, mut sum, mut bound, mut order) = (Z, Z, ratio, 3.0);
    while bound > f64::EPSILON * order {
        power = power * square;
        sum += power * (1.0 / order);
        bound *= ratio;
        order += 2.0;
    }
    Some(sum.symmetric_part())
}

/// The inverse of a symmetric matrix within 0.2 of 2 I: by cofactors in space, since nothing cancels in them there.
#[inline]
fn inverse_near_rest<const D: usize>(matrix: &Matrix<D>) -> Option<Matrix<D>> {
    if D != 3 {
        return matrix.inverse();
    }
    let rows = &matrix.0;
    let cofactor = |i: usize, j: usize| {
        let (k, l, m, n) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        rows[k][m] * rows[l][n] - rows[k][n] * rows[l][m]
    };
    let adjugate = Matrix::<D>::from_fn(|i, j| cofactor(i.max(j), i.min(j)));
    Some(adjugate * (1.0 / vector::dot(&rows[0], &adjugate.0[0])))
}

/// Any strain.
fn by_jacobi<const D: usize>(F: &Matrix<D>, squared_strain: &Matrix<D>) -> Option<Matrix<D>> {
    let eigen = SymmetricEigen::new(squared_strain)?;
    if eigen.values.iter().all(|&value| 1.0 + value > FAR_FROM_REST) {
        return Some(eigen.map(|value| 0.5 * value.ln_1p()));
    }
    let SingularValues { left, values, .. } = SingularValues::new(F)?;
    Some(SymmetricEigen { values, vectors: left }.map(f64::ln))
}

/// D = 2, J = det F.
#[inline]
fn plane<const D: usize>(F: &Matrix<D>, J: f64) -> Matrix<D> {
    let (H, squared_strain) = strains_from_rest(F);
    let (b, mean, log_J) = if H.maximum_norm() < FAR_FROM_REST {
        let log_J = (H.trace() + H.determinant()).ln_1p();
        (squared_strain, 1.0 + 0.5 * squared_strain.trace(), log_J)
    } else {
        let b = left_cauchy_green(F);
        (b, 0.5 * b.trace(), J.ln())
    };
    let (difference, off_diagonal) = (0.5 * b.0[0][0] - 0.5 * b.0[1][1], b.0[0][1]);
    let radius = (difference * difference + off_diagonal * off_diagonal).sqrt();
    let ratio = radius / mean;
    let per_radius = if radius == 0.0 {
        1.0 / mean
    } else if ratio < FAR_FROM_REST {
        ratio.atanh() / radius
    } else {
        // b̄² − r² = J², so artanh(r / b̄) = ln((b̄ + r) / J).
        ((mean + radius) / J).ln() / radius
    };
    let (difference, off_diagonal) = (0.5 * per_radius * difference, 0.5 * per_radius * off_diagonal);
    let mut strain = Matrix([[off_diagonal; D]; D]);
    strain.0[0][0] = 0.5 * log_J + difference;
    strain.0[1][1] = 0.5 * log_J - difference;
    strain
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The oracle: stretches and axes of F by one-sided Jacobi, which keeps every digit of a small stretch.
    fn oracle<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
        let decomposition = SingularValues::new(F).expect("finite");
        let logarithms = Matrix::diagonal(&decomposition.values.map(f64::ln));
        decomposition.left * logarithms * decomposition.left.transpose()
    }

    fn agrees<const D: usize>(numbers: &[f64], size: f64) -> Result<(), TestCaseError> {
        let F = Matrix::<D>::from_fn(|i, j| f64::from(u8::from(i == j)) + size * numbers[D * i + j]);
        prop_assume!(F.determinant() > 1e-3);
        let strain = log_strain(&F).expect("in range");
        prop_assert_eq!(strain, strain.transpose());
        let error = (strain - oracle(&F)).frobenius_norm();
        prop_assert!(error < 1e-14 / F.determinant().min(1.0), "D = {D}: off by {error:e}");
        Ok(())
    }

    /// Above the strain's deviator, and hardly above a small one.
    fn bounds<const D: usize>(numbers: &[f64], size: f64) -> Result<(), TestCaseError> {
        let F = Matrix::<D>::from_fn(|i, j| f64::from(u8::from(i == j)) + size * numbers[D * i + j]);
        prop_assume!(F.determinant() > 1e-3);
        let strain = log_strain(&F).expect("in range");
        let deviator = (strain - Matrix::IDENTITY * (strain.trace() / D as f64)).frobenius_norm();
        let bound = deviator_bound(&F);
        prop_assert!(bound >= deviator, "D = {D}: {bound:e} {deviator:e}");
        if size < 1e-3 {
            prop_assert!(
                bound < deviator + 20.0 * D as f64 * size * size + 1e-6 * size,
                "D = {D}: {bound:e} {deviator:e}"
            );
        }
        Ok(())
    }

    /// ε = ½ (H + Hᵀ) + O(‖H‖²), kept to all digits of H, equal stretches or not.
    fn small_strains_keep_their_digits<const D: usize>(numbers: &[f64]) -> Result<(), TestCaseError> {
        // Multiples of the spacing of the numbers near one, so that F − I is exactly H.
        let H = Matrix::<D>::from_fn(|i, j| (numbers[D * i + j] * 64.0).round() * f64::EPSILON);
        let strain = log_strain(&(Matrix::IDENTITY + H)).expect("in range");
        let error = (strain - H.symmetric_part()).frobenius_norm();
        let size = H.frobenius_norm();
        prop_assert!(error <= (size + 2e-15) * size, "D = {D}: {error:e}");
        Ok(())
    }

    proptest! {
        #[test]
        fn the_strain_is_that_of_the_singular_values(
            numbers in prop::collection::vec(-1.0..1.0, 16),
            exponent in 0..16i32,
        ) {
            let size = 10f64.powi(-exponent);
            mpm_tensor::in_dimensions!(agrees(&numbers, size)?, 1, 2, 3, 4);
            mpm_tensor::in_dimensions!(bounds(&numbers, size)?, 1, 2, 3, 4);
        }

        #[test]
        fn small_strains(numbers in prop::collection::vec(-1.0..1.0, 16)) {
            mpm_tensor::in_dimensions!(small_strains_keep_their_digits(&numbers)?, 1, 2, 3, 4);
        }
    }

    #[test]
    fn extreme_stretches_keep_their_logarithms() {
        let turn = Matrix([[0.6, -0.8], [0.8, 0.6]]);
        for stretches in [[1e-9f64, 1.0], [1e-9, 1e-9], [1e-7, 1e7], [1e9, 1e9]] {
            let strain = log_strain(&(turn * Matrix::diagonal(&stretches))).expect("in range");
            let expected = turn * Matrix::diagonal(&stretches.map(f64::ln)) * turn.transpose();
            assert!((strain - expected).frobenius_norm() < 2e-14 * stretches[0].ln().abs());
        }
        let strain = log_strain(&Matrix::diagonal(&[1e-9, 1.0, 1e-4])).expect("in range");
        let expected = Matrix::diagonal(&[1e-9f64.ln(), 0.0, 1e-4f64.ln()]);
        assert!((strain - expected).frobenius_norm() < 1e-14);
    }

    #[test]
    fn inverted_or_broken_gradients_have_none() {
        for F in [
            Matrix::diagonal(&[1.0, -1.0]),
            Matrix::ZERO,
            Matrix([[f64::NAN, 0.0], [0.0, 1.0]]),
            Matrix::diagonal(&[f64::INFINITY, 1.0]),
        ] {
            assert!(log_strain(&F).is_none());
        }
    }
}
