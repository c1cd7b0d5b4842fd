//! A regression as a sum over its rows.

use std::marker::PhantomData;

use mpm_tensor::vector;

use crate::posterior::Posterior;
use crate::{Link, Regression, SumTarget, Target};

/// The terms are ℓ(b_i x_iᵀβ) with ℓ of the [`Link`]; what is linear in β over all rows, Σ_i a_i x_iᵀβ + c_i, stands with the prior, where it
/// costs nothing and has no variance.
///
/// Rows beyond the last contribute nothing.
impl<L: Link, const D: usize> SumTarget<D> for Regression<L, D> {
    fn terms(&self) -> usize {
        self.posterior.rows.len()
    }

    fn prior_log_density(&self, x: &[f64; D]) -> f64 {
        self.posterior.without_rows(x)
    }

    fn prior_score(&self, x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|k| self.posterior.linear[k] - self.posterior.precision[k] * x[k])
    }

    fn term_log_density(&self, term: usize, x: &[f64; D]) -> f64 {
        let row = self.posterior.rows.get(term);
        row.map_or(0.0, |row| L::log_likelihood(vector::dot(row, x)))
    }

    fn term_score(&self, term: usize, x: &[f64; D]) -> [f64; D] {
        let row = self.posterior.rows.get(term);
        row.map_or([0.0; D], |row| vector::scale(row, L::slope(vector::dot(row, x))))
    }

    /// Matrix products, as for the scores of all rows.
    fn sums_of_term_scores(&self, terms: &[usize], xs: &[[f64; D]], out: &mut [[f64; D]]) {
        let rows: Vec<[f64; D]> = terms
            .iter()
            .filter_map(|&term| self.posterior.rows.get(term))
            .copied()
            .collect();
        let part = Posterior::<L, D> {
            rows,
            linear: [0.0; D],
            constant: 0.0,
            precision: [0.0; D],
            link: PhantomData,
        };
        part.scores(xs, out);
    }

    fn full_log_density(&self, x: &[f64; D]) -> f64 {
        self.log_density(x)
    }
}
