//! The left Cauchy–Green tensor and a bound of the largest stretch.

use mpm_tensor::{Matrix, vector};

/// b = F Fᵀ, exactly symmetric.
#[allow(non_snake_case)]
#[inline]
pub(crate) fn left_cauchy_green<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
    Matrix::from_fn(|i, j| vector::dot(&F.0[i], &F.0[j]))
}

/// An upper bound of Λ², Λ the largest principal stretch (largest singular value of F): the largest sum of absolute
/// entries over the rows of b, which bounds its eigenvalues (Gershgorin). Exact for diagonal b, never above √D Λ².
///
/// NaN if an entry of b is NaN.
#[allow(non_snake_case)]
#[inline]
pub(crate) fn largest_squared_stretch<const D: usize>(F: &Matrix<D>) -> f64 {
    let b = left_cauchy_green(F);
    vector::maximum_norm(&b.0.map(|row| row.iter().map(|entry| entry.abs()).sum()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_tensor::SingularValues;

    #[test]
    #[allow(non_snake_case)]
    fn the_bound_is_above_the_stretch_and_exact_for_principal_axes() {
        assert_eq!(largest_squared_stretch(&Matrix::diagonal(&[0.5, 2.0, 1.0])), 4.0);
        let F = Matrix([[1.1, 0.4, 0.0], [-0.2, 0.8, 0.3], [0.1, 0.5, 1.3]]);
        let stretch = SingularValues::new(&F).expect("finite entries").values[0];
        let bound = largest_squared_stretch(&F);
        assert!(bound >= stretch * stretch && bound <= 3f64.sqrt() * stretch * stretch);
        assert!(largest_squared_stretch(&Matrix([[1.0, f64::NAN], [0.0, 1.0]])).is_nan());
    }
}
