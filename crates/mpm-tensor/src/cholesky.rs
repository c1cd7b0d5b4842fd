//! The Cholesky factorisation of a symmetric positive definite matrix.

use crate::{Matrix, vector};

/// A pivot of the Cholesky factorisation was not a positive finite number, so the matrix is not positive definite to
/// working precision.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the matrix is not positive definite: pivot {index} is {pivot}")]
pub struct NotPositiveDefinite {
    /// The zero-based row of the pivot. The leading minor of this size is still positive definite.
    pub index: usize,
    /// The pivot A_kk − Σ_{j<k} L_kj², the Schur complement of the leading minor; NaN for NaN entries.
    pub pivot: f64,
}

/// The factorisation A = L Lᵀ of a symmetric positive definite matrix, L lower triangular with a positive diagonal.
///
/// Source: Golub & Van Loan, *Matrix Computations*, 4th ed., §4.2.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cholesky<const D: usize> {
    lower: Matrix<D>,
}

impl<const D: usize> Cholesky<D> {
    /// Factorises `matrix`, of which only the lower triangle is read.
    ///
    /// # Errors
    ///
    /// [`NotPositiveDefinite`] with the first pivot that is zero, negative, infinite or NaN.
    pub fn new(matrix: &Matrix<D>) -> Result<Self, NotPositiveDefinite> {
        let mut lower = Matrix::ZERO;
        for i in 0..D {
            for k in 0..=i {
                let mut rest = matrix.0[i][k];
                for j in 0..k {
                    rest -= lower.0[i][j] * lower.0[k][j];
                }
                if k < i {
                    lower.0[i][k] = rest / lower.0[k][k];
                } else if rest > 0.0 && rest.is_finite() {
                    lower.0[i][i] = rest.sqrt();
                } else {
                    return Err(NotPositiveDefinite { index: i, pivot: rest });
                }
            }
        }
        Ok(Self { lower })
    }

    /// The factor L, zero above the diagonal. The map x = μ + L z takes N(0, I) to N(μ, A).
    #[inline]
    pub fn lower(&self) -> &Matrix<D> {
        &self.lower
    }

    /// The solution x of A x = b, by L y = b and Lᵀ x = y.
    #[inline]
    pub fn solve(&self, right_hand_side: &[f64; D]) -> [f64; D] {
        self.solve_lower_transposed(&self.solve_lower(right_hand_side))
    }

    /// The solution y of L y = b; ‖y‖² = bᵀ A⁻¹ b is the squared Mahalanobis length of b.
    #[inline]
    pub fn solve_lower(&self, right_hand_side: &[f64; D]) -> [f64; D] {
        let mut solution = *right_hand_side;
        for i in 0..D {
            for j in 0..i {
                solution[i] -= self.lower.0[i][j] * solution[j];
            }
            solution[i] /= self.lower.0[i][i];
        }
        solution
    }

    /// The solution x of Lᵀ x = b.
    #[inline]
    pub fn solve_lower_transposed(&self, right_hand_side: &[f64; D]) -> [f64; D] {
        let mut solution = *right_hand_side;
        for i in (0..D).rev() {
            for j in i + 1..D {
                solution[i] -= self.lower.0[j][i] * solution[j];
            }
            solution[i] /= self.lower.0[i][i];
        }
        solution
    }

    /// The logarithm of the determinant, log det A = 2 Σ_i log L_ii; the determinant itself may overflow.
    #[inline]
    pub fn log_determinant(&self) -> f64 {
        let mut sum = 0.0;
        for i in 0..D {
            sum += self.lower.0[i][i].ln();
        }
        2.0 * sum
    }

    /// The inverse A⁻¹ = L⁻ᵀ L⁻¹, exactly symmetric; `None` if it overflows.
    pub fn inverse(&self) -> Option<Matrix<D>> {
        let lower_inverse = self.lower.lower_triangular_inverse()?;
        let mut inverse = Matrix::ZERO;
        for row in &lower_inverse.0 {
            for i in 0..D {
                vector::accumulate(&mut inverse.0[i], row[i], row);
            }
        }
        inverse.is_finite().then_some(inverse)
    }
}

impl<const D: usize> Matrix<D> {
    /// The inverse of the lower triangle of this matrix, itself lower triangular; entries above the diagonal are not read.
    ///
    /// By forward substitution (Golub & Van Loan, §3.1). `None` if the result is not finite: a zero on the diagonal, an
    /// entry that is not finite, or overflow.
    pub fn lower_triangular_inverse(&self) -> Option<Self> {
        let mut inverse = Self::ZERO;
        for i in 0..D {
            let mut row = [0.0; D];
            row[i] = 1.0;
            for k in 0..i {
                vector::accumulate(&mut row, -self.0[i][k], &inverse.0[k]);
            }
            for entry in &mut row[..=i] {
                *entry /= self.0[i][i];
            }
            inverse.0[i] = row;
            if !self.0[i][i].is_finite() {
                return None;
            }
        }
        inverse.is_finite().then_some(inverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Matrix<2> = Matrix([[4.0, 2.0], [2.0, 10.0]]);

    #[test]
    fn the_factor_and_its_solutions_are_the_textbook_ones() {
        let factor = Cholesky::new(&A).expect("positive definite");
        assert_eq!(*factor.lower(), Matrix([[2.0, 0.0], [1.0, 3.0]]));
        assert_eq!(factor.solve(&[8.0, 22.0]), [1.0, 2.0]);
        assert_eq!(factor.solve_lower(&[2.0, 7.0]), [1.0, 2.0]);
        assert_eq!(factor.solve_lower_transposed(&[4.0, 6.0]), [1.0, 2.0]);
        assert!((factor.log_determinant() - 36f64.ln()).abs() < 1e-15);
        let identity = factor.inverse().expect("well conditioned") * A;
        assert!((identity - Matrix::IDENTITY).frobenius_norm() < 1e-15);
    }

    #[test]
    fn the_error_names_the_pivot() {
        let indefinite = Matrix([[1.0, 2.0], [2.0, 1.0]]);
        let error = Cholesky::new(&indefinite).expect_err("indefinite");
        assert_eq!(error, NotPositiveDefinite { index: 1, pivot: -3.0 });
        assert_eq!(error.to_string(), "the matrix is not positive definite: pivot 1 is -3");
        let error = Cholesky::new(&Matrix([[f64::NAN]])).expect_err("not a number");
        assert!(error.index == 0 && error.pivot.is_nan());
        assert!(Cholesky::new(&Matrix([[f64::INFINITY]])).is_err());
    }

    #[test]
    fn triangles_without_an_inverse_have_none() {
        let lower = Matrix([[2.0, 9.0], [1.0, 4.0]]);
        assert_eq!(
            lower.lower_triangular_inverse(),
            Some(Matrix([[0.5, 0.0], [-0.125, 0.25]]))
        );
        assert_eq!(Matrix::<3>::ZERO.lower_triangular_inverse(), None);
        assert_eq!(Matrix([[f64::INFINITY]]).lower_triangular_inverse(), None);
        assert_eq!(Matrix([[1.0, 0.0], [f64::NAN, 1.0]]).lower_triangular_inverse(), None);
    }
}
