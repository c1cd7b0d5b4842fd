//! Gaussian elimination with partial pivoting, for dimensions beyond the closed forms.

use crate::{Matrix, vector};

/// The factors P A = L U of a matrix with finite entries (Golub & Van Loan, *Matrix Computations*, 4th ed., Alg. 3.4.1).
pub(crate) struct LowerUpper<const D: usize> {
    /// U on and above the diagonal, L without its unit diagonal below.
    factors: Matrix<D>,
    /// Row i of P A is row `rows[i]` of A.
    rows: [usize; D],
    /// The determinant of P, ±1.
    sign: f64,
}

impl<const D: usize> LowerUpper<D> {
    /// Factorises; a column without a non-zero pivot is left as it is, so that U has a zero on its diagonal.
    pub(crate) fn new(matrix: &Matrix<D>) -> Self {
        let mut factors = *matrix;
        let mut rows = std::array::from_fn(|i| i);
        let mut sign = 1.0;
        for k in 0..D {
            let mut pivot_row = k;
            for i in k + 1..D {
                if factors.0[i][k].abs() > factors.0[pivot_row][k].abs() {
                    pivot_row = i;
                }
            }
            if pivot_row != k {
                factors.0.swap(k, pivot_row);
                rows.swap(k, pivot_row);
                sign = -sign;
            }
            let pivot = factors.0[k][k];
            if pivot == 0.0 {
                continue;
            }
            for i in k + 1..D {
                let factor = factors.0[i][k] / pivot;
                factors.0[i][k] = factor;
                for j in k + 1..D {
                    factors.0[i][j] -= factor * factors.0[k][j];
                }
            }
        }
        Self { factors, rows, sign }
    }

    /// det A = det P · Π_i U_ii.
    pub(crate) fn determinant(&self) -> f64 {
        let mut product = self.sign;
        for i in 0..D {
            product *= self.factors.0[i][i];
        }
        product
    }

    /// A⁻¹ by forward and back substitution on the rows of the permutation; not finite where U has a zero pivot.
    pub(crate) fn inverse(&self) -> Matrix<D> {
        let mut inverse = Matrix::ZERO;
        for i in 0..D {
            let mut row = [0.0; D];
            row[self.rows[i]] = 1.0;
            for k in 0..i {
                vector::accumulate(&mut row, -self.factors.0[i][k], &inverse.0[k]);
            }
            inverse.0[i] = row;
        }
        for i in (0..D).rev() {
            let mut row = inverse.0[i];
            for k in i + 1..D {
                vector::accumulate(&mut row, -self.factors.0[i][k], &inverse.0[k]);
            }
            for entry in &mut row {
                *entry /= self.factors.0[i][i];
            }
            inverse.0[i] = row;
        }
        inverse
    }
}
