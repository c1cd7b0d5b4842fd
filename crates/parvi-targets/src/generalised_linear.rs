//! The derivatives of the log posterior of a regression: one point straight from the definitions, batches as products.

use mpm_tensor::{Matrix, vector};

use crate::posterior::Posterior;
use crate::{Curvature, Link, Target, generalised_linear_batch};

impl<L: Link, const D: usize> Target<D> for Posterior<L, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        // Partial sums: the rounding of a long sum grows with its length.
        let of_row = |row: &[f64; D]| L::log_likelihood(vector::dot(row, x));
        let of_rows: f64 = self
            .rows
            .chunks(64)
            .map(|rows| rows.iter().map(of_row).sum::<f64>())
            .sum();
        of_rows + self.without_rows(x)
    }

    /// Σ b_i ℓ′(b_i x_iᵀβ) x_i + a − precision ∘ β.
    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut score = std::array::from_fn(|k| self.linear[k] - self.precision[k] * x[k]);
        if D > 1 {
            self.add_slopes(&self.rows, x, &mut score);
            return score;
        }
        for rows in self.rows.chunks(generalised_linear_batch::summed_together::<D>()) {
            let mut sum = [0.0; D];
            self.add_slopes(rows, x, &mut sum);
            vector::accumulate(&mut score, 1.0, &sum);
        }
        score
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        generalised_linear_batch::scores(self, xs, out);
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        generalised_linear_batch::log_densities(self, xs, out);
    }
}

impl<L: Link, const D: usize> Posterior<L, D> {
    /// Σ_i ℓ′(b_i x_iᵀβ) b_i x_i of some rows.
    fn add_slopes(&self, rows: &[[f64; D]], x: &[f64; D], sum: &mut [f64; D]) {
        for row in rows {
            vector::accumulate(sum, L::slope(vector::dot(row, x)), row);
        }
    }
}

impl<L: Link, const D: usize> Curvature<D> for Posterior<L, D> {
    /// −Σ ℓ″(b_i x_iᵀβ) x_i x_iᵀ + diag(precision).
    fn negative_hessian(&self, x: &[f64; D]) -> Matrix<D> {
        let mut hessian = Matrix::diagonal(&self.precision);
        for row in &self.rows {
            let weight = L::curvature(vector::dot(row, x));
            for i in 0..D {
                vector::accumulate(&mut hessian.0[i], weight * row[i], row);
            }
        }
        hessian
    }
}
