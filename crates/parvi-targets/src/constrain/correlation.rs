//! The correlations of a correlation matrix.

use super::partial_correlations::{self, entries_below_diagonal, entries_of_triangle, row, strict_row};
use super::transform::{OutsideSupport, Transform, check_each};

/// The entries R_ij below the diagonal of a correlation matrix, row by row, K(K−1)/2 of them; R = L Lᵀ with the factor L of
/// [`CorrelationCholesky`](super::correlation_cholesky::CorrelationCholesky).
///
/// Row i of R depends on row i of L through the rows above it, with determinant Π_{j<i} L_jj, and so
/// log |det J| = Σ_{i>j} [½(K − 2 − j) + 1] log(1 − tanh² y_ij), counted from 0 (Lewandowski, Kurowicka & Joe 2009; Stan Reference
/// Manual, "Constraint transforms": correlation matrices).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Correlation {
    /// K ≥ 2.
    pub size: usize,
}

impl Correlation {
    fn factor(&self, y: &[f64]) -> Vec<f64> {
        let mut factor = vec![0.0; entries_of_triangle(self.size)];
        partial_correlations::factor(self.size, y, &mut factor);
        factor
    }

    fn coefficient(&self, _i: usize, j: usize) -> f64 {
        0.5 * (self.size - 2 - j) as f64 + 1.0
    }
}

impl Transform for Correlation {
    fn name(&self) -> &str {
        "correlation"
    }

    fn constrained_dimension(&self) -> usize {
        entries_below_diagonal(self.size)
    }

    fn unconstrained_dimension(&self) -> usize {
        entries_below_diagonal(self.size)
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        let factor = self.factor(y);
        for i in 0..self.size {
            for j in 0..i {
                let products = row(&factor, i).iter().zip(row(&factor, j));
                x[entries_below_diagonal(i) + j] = products.map(|(a, b)| a * b).sum::<f64>().clamp(-1.0, 1.0);
            }
        }
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        partial_correlations::log_jacobian(self.size, y, |i, j| self.coefficient(i, j))
    }

    /// With S the symmetric matrix of the score and a diagonal of zeros, the derivatives in L are the lower triangle of S L.
    fn pull_back(&self, y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        let factor = self.factor(y);
        let mut of_factor = vec![0.0; factor.len()];
        for i in 0..self.size {
            for j in 0..i {
                let derivative = strict_row(score, i)[j];
                for k in 0..=j {
                    of_factor[entries_of_triangle(i) + k] += derivative * row(&factor, j)[k];
                    of_factor[entries_of_triangle(j) + k] += derivative * row(&factor, i)[k];
                }
            }
        }
        let coefficient = |i, j| self.coefficient(i, j);
        partial_correlations::pull_back(self.size, y, &factor, &of_factor, coefficient, out);
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        check_each(x, "a correlation above -1 and below 1", |_, x| x.abs() < 1.0)?;
        let mut factor = vec![0.0; entries_of_triangle(self.size)];
        for i in 0..self.size {
            let start = entries_of_triangle(i);
            let mut pivot = 1.0;
            for j in 0..i {
                let products = (0..j).map(|k| factor[start + k] * row(&factor, j)[k]);
                let entry = (strict_row(x, i)[j] - products.sum::<f64>()) / row(&factor, j)[j];
                pivot -= entry * entry;
                factor[start + j] = entry;
            }
            if pivot.is_nan() || pivot <= 0.0 {
                let coordinate = entries_below_diagonal(i) + i - 1;
                return Err(OutsideSupport {
                    coordinate,
                    value: x[coordinate],
                    allowed: "a correlation that leaves the matrix positive definite",
                });
            }
            factor[start + i] = pivot.sqrt();
        }
        partial_correlations::unconstrain(self.size, &factor, y)
    }
}
