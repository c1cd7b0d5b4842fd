//! A logistic regression as a sum over its rows.

use mpm_tensor::vector;

use crate::special::log_one_plus_exp;
use crate::{LogisticRegression, SumTarget, Target, logistic_batch};

/// ℓ_i(β) = −log(1 + e^−t_i) with the margin t_i = (2y_i − 1) x_iᵀβ, ∇ℓ_i = (2y_i − 1) x_i σ(−t_i); ℓ₀ = −½ Σ_k β_k²/s_k².
///
/// Rows beyond the last contribute nothing.
impl<const D: usize> SumTarget<D> for LogisticRegression<D> {
    fn terms(&self) -> usize {
        self.signed_rows.len()
    }

    fn prior_log_density(&self, x: &[f64; D]) -> f64 {
        -0.5 * (0..D).map(|k| self.precision[k] * x[k] * x[k]).sum::<f64>()
    }

    fn prior_score(&self, x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|k| -self.precision[k] * x[k])
    }

    fn term_log_density(&self, term: usize, x: &[f64; D]) -> f64 {
        let row = self.signed_rows.get(term);
        row.map_or(0.0, |row| -log_one_plus_exp(-vector::dot(row, x)))
    }

    fn term_score(&self, term: usize, x: &[f64; D]) -> [f64; D] {
        let row = self.signed_rows.get(term);
        row.map_or([0.0; D], |row| {
            vector::scale(row, 1.0 / (1.0 + vector::dot(row, x).exp()))
        })
    }

    /// Matrix products, as for the scores of all rows.
    fn sums_of_term_scores(&self, terms: &[usize], xs: &[[f64; D]], out: &mut [[f64; D]]) {
        let rows: Vec<[f64; D]> = terms
            .iter()
            .filter_map(|&term| self.signed_rows.get(term))
            .copied()
            .collect();
        logistic_batch::scores(&rows, &[0.0; D], xs, out);
    }

    fn full_log_density(&self, x: &[f64; D]) -> f64 {
        self.log_density(x)
    }
}
