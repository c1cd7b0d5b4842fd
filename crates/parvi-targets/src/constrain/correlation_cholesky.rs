//! The Cholesky factor of a correlation matrix.

use super::partial_correlations::{self, entries_below_diagonal, entries_of_triangle};
use super::transform::{OutsideSupport, Transform};

/// The lower triangle of L with L Lᵀ a correlation matrix, row by row with its diagonal, K(K+1)/2 entries.
///
/// In the entries below the diagonal log |det J| = Σ_{i>j} [½(i − 1 − j) + 1] log(1 − tanh² y_ij), counted from 0: a factor
/// r_ij per entry and 1 − z² of the tanh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CorrelationCholesky {
    /// K ≥ 2.
    pub size: usize,
}

fn coefficient(i: usize, j: usize) -> f64 {
    0.5 * (i - 1 - j) as f64 + 1.0
}

impl Transform for CorrelationCholesky {
    fn name(&self) -> &str {
        "correlation Cholesky factor"
    }

    fn constrained_dimension(&self) -> usize {
        entries_of_triangle(self.size)
    }

    fn unconstrained_dimension(&self) -> usize {
        entries_below_diagonal(self.size)
    }

    /// Those below the diagonal.
    fn independent_coordinates(&self) -> Vec<usize> {
        let row = |i| (0..i).map(move |j| entries_of_triangle(i) + j);
        (0..self.size).flat_map(row).collect()
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        partial_correlations::factor(self.size, y, x);
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        partial_correlations::log_jacobian(self.size, y, coefficient)
    }

    fn pull_back(&self, y: &[f64], x: &[f64], score: &[f64], out: &mut [f64]) {
        partial_correlations::pull_back(self.size, y, x, score, coefficient, out);
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        partial_correlations::unconstrain(self.size, x, y)
    }
}
