//! The exponential of a symmetric matrix.

use mpm_tensor::{Matrix, SymmetricEigen};

/// Largest ‖X‖ for the power series.
const SERIES_RANGE: f64 = 0.25;

/// exp X of a symmetric X, exactly symmetric: undoes [`log_strain`](crate::log_strain::log_strain) in a return mapping.
///
/// In the plane, with the mean m of the diagonal and the eigenvalues m ± r, e^m (cosh r I + sinh r / r (X − m I)); for
/// ‖X‖ ≤ ¼ by the power series; by the principal axes otherwise. NaN if an entry is not finite.
#[inline]
pub(crate) fn exponential<const D: usize>(X: &Matrix<D>) -> Matrix<D> {
    match D {
        2 => plane(X),
        _ if X.frobenius_norm() <= SERIES_RANGE => series(X),
        _ => SymmetricEigen::new(X).map_or(Matrix([[f64::NAN; D]; D]), |eigen| eigen.map(f64::exp)),
    }
}

/// Σ_k X^k / k!.
#[inline]
fn series<const D: usize>(X: &Matrix<D>) -> Matrix<D> {
    let size = X.frobenius_norm();
    let (mut term, mut bound, mut order) = (*X, size, 1.0);
    let mut sum = Matrix::IDENTITY + *X;
    while bound > f64::EPSILON {
        order += 1.0;
        term = term * *X * (1.0 / order);
        sum += term;
        bound *= size / order;
    }
    sum.symmetric_part()
}

/// D = 2.
#[inline]
fn plane<const D: usize>(X: &Matrix<D>) -> Matrix<D> {
    let mean = 0.5 * X.trace();
    let (difference, off_diagonal) = (0.5 * X.0[0][0] - 0.5 * X.0[1][1], X.0[0][1]);
    let radius = (difference * difference + off_diagonal * off_diagonal).sqrt();
    let (growth, cosh) = (mean.exp(), radius.cosh());
    let per_radius = if radius == 0.0 { 1.0 } else { radius.sinh() / radius };
    let mut exponential = Matrix([[growth * per_radius * off_diagonal; D]; D]);
    exponential.0[0][0] = growth * (cosh + per_radius * difference);
    exponential.0[1][1] = growth * (cosh - per_radius * difference);
    exponential
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log_strain::log_strain;
    use proptest::prelude::*;

    fn agrees<const D: usize>(numbers: &[f64], size: f64) -> Result<(), TestCaseError> {
        let X = Matrix::<D>::from_fn(|i, j| size * numbers[D * i + j]).symmetric_part();
        let exponential = exponential(&X);
        prop_assert_eq!(exponential, exponential.transpose());
        let oracle = SymmetricEigen::new(&X).expect("finite").map(f64::exp);
        let scale = oracle.frobenius_norm();
        let error = (exponential - oracle).frobenius_norm();
        prop_assert!(error < 4e-15 * scale, "D = {D}: off by {error:e}");
        // ½ ln(e^X e^X) = X.
        let back = log_strain(&exponential).expect("positive definite");
        let error = (back - X).frobenius_norm();
        prop_assert!(error < 1e-14 * scale, "D = {D}: back off by {error:e}");
        Ok(())
    }

    proptest! {
        #[test]
        fn the_exponential_is_that_of_the_principal_axes(
            numbers in prop::collection::vec(-1.0..1.0, 16),
            exponent in 0..16i32,
        ) {
            let size = 10f64.powi(-exponent);
            mpm_tensor::in_dimensions!(agrees(&numbers, size)?, 1, 2, 3, 4);
        }
    }

    #[test]
    fn known_exponentials_and_broken_entries() {
        assert_eq!(exponential(&Matrix::<2>::ZERO), Matrix::IDENTITY);
        assert_eq!(exponential(&Matrix::<3>::ZERO), Matrix::IDENTITY);
        for value in [f64::NAN, f64::INFINITY] {
            assert!(!exponential(&Matrix([[value, 0.0], [0.0, 1.0]])).is_finite());
            assert!(!exponential(&Matrix::diagonal(&[1.0, value, 0.0])).is_finite());
        }
    }
}
