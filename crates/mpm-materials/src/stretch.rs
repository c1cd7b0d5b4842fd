//! The left Cauchy–Green tensor and bounds of the stretches.

use mpm_tensor::{Matrix, vector};

/// b = F Fᵀ, exactly symmetric.
#[inline]
pub(crate) fn left_cauchy_green<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
    Matrix::from_fn(|i, j| vector::dot(&F.0[i], &F.0[j]))
}

/// An upper bound of Λ², Λ the largest principal stretch (largest singular value of F): the largest sum of absolute
/// entries over the rows of b, which bounds its eigenvalues (Gershgorin). Exact for diagonal b, never above √D Λ².
///
/// NaN if an entry of b is NaN.
#[inline]
pub(crate) fn largest_squared_stretch<const D: usize>(F: &Matrix<D>) -> f64 {
    let b = left_cauchy_green(F);
    vector::maximum_norm(&b.0.map(|row| row.iter().map(|entry| entry.abs()).sum()))
}

/// Bounds (ℓ², Λ²) of the squared stretches from below and above: [`largest_squared_stretch`], and the larger of the
/// least (diagonal entry − absolute rest of its row) of b and J² / Λ^(2(D−1)), which is positive for J > 0. Exact for F
/// = α R.
///
/// NaN if an entry of b is NaN.
#[inline]
pub(crate) fn squared_stretch_range<const D: usize>(F: &Matrix<D>) -> (f64, f64) {
    let b = left_cauchy_green(F);
    let mut smallest = f64::INFINITY;
    let mut largest = 0.0;
    for i in 0..D {
        let size: f64 = b.0[i].iter().map(|entry| entry.abs()).sum();
        if size.is_nan() {
            return (f64::NAN, f64::NAN);
        }
        smallest = f64::min(smallest, 2.0 * b.0[i][i] - size);
        largest = f64::max(largest, size);
    }
    let J = F.determinant();
    let mut by_volume = J * J;
    for _ in 1..D {
        by_volume /= largest;
    }
    (f64::max(smallest, by_volume), largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_tensor::SingularValues;

    #[test]
    fn the_bound_is_above_the_stretch_and_exact_for_principal_axes() {
        assert_eq!(largest_squared_stretch(&Matrix::diagonal(&[0.5, 2.0, 1.0])), 4.0);
        let F = Matrix([[1.1, 0.4, 0.0], [-0.2, 0.8, 0.3], [0.1, 0.5, 1.3]]);
        let stretch = SingularValues::new(&F).expect("finite entries").values[0];
        let bound = largest_squared_stretch(&F);
        assert!(bound >= stretch * stretch && bound <= 3f64.sqrt() * stretch * stretch);
        assert!(largest_squared_stretch(&Matrix([[1.0, f64::NAN], [0.0, 1.0]])).is_nan());
    }

    #[test]
    fn the_range_holds_the_stretches() {
        for F in [
            Matrix([[1.1, 0.4, 0.0], [-0.2, 0.8, 0.3], [0.1, 0.5, 1.3]]),
            Matrix([[1.01, 0.02, 0.0], [-0.01, 0.98, 0.0], [0.01, 0.0, 1.0]]),
            Matrix::diagonal(&[0.5, 2.0, 1.0]),
        ] {
            let (smallest, largest) = squared_stretch_range(&F);
            let [upper, _, lower] = SingularValues::new(&F).expect("finite entries").values;
            assert!(0.0 < smallest && smallest <= lower * lower && upper * upper <= largest);
            assert_eq!(largest, largest_squared_stretch(&F));
        }
        assert_eq!(squared_stretch_range(&(Matrix::<2>::IDENTITY * 0.5)), (0.25, 0.25));
        assert!(squared_stretch_range(&Matrix([[f64::NAN, 0.0], [0.0, 1.0]])).0.is_nan());
    }
}
