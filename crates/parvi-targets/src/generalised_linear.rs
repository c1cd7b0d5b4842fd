//! The log posterior of a regression and its derivatives: one point straight from the definitions, batches as products.

use std::marker::PhantomData;

use mpm_tensor::{Matrix, vector};

use crate::{Curvature, Link, RegressionTable, Response, Target, TargetError, generalised_linear_batch};

/// log p(β) = Σ_i [a_i x_iᵀβ + ℓ(b_i x_iᵀβ) + c_i] − ½ Σ_k precision_k β_k², with a, b, c of the [`Response`]s and ℓ of the
/// [`Link`]. A flat prior has precision 0.
#[derive(Clone, Debug)]
pub(crate) struct Posterior<L, const D: usize> {
    /// b_i x_i: with the sign of a yes or no in the row one ℓ serves both, and nothing cancels in either tail.
    pub(crate) rows: Vec<[f64; D]>,
    /// Σ a_i x_i.
    pub(crate) linear: [f64; D],
    /// Σ c_i.
    pub(crate) constant: f64,
    /// 1/s_k², zero for a flat prior.
    pub(crate) precision: [f64; D],
    pub(crate) link: PhantomData<L>,
}

impl<L: Link, const D: usize> Posterior<L, D> {
    /// The posterior of `data` under a prior of the given precisions; an error unless D is the data's dimension.
    pub(crate) fn new(data: &RegressionTable<L::Response>, precision: [f64; D]) -> Result<Self, TargetError> {
        let mut rows = data.rows_of::<D>()?;
        let (mut linear, mut constant) = ([0.0; D], 0.0);
        for (row, response) in rows.iter_mut().zip(data.responses()) {
            vector::accumulate(&mut linear, response.linear(), row);
            constant += response.constant();
            *row = row.map(|x| response.sign() * x);
        }
        Ok(Self {
            rows,
            linear,
            constant,
            precision,
            link: PhantomData,
        })
    }

    /// aᵀβ + c − ½ Σ precision_k β_k².
    pub(crate) fn without_rows(&self, coefficients: &[f64; D]) -> f64 {
        let prior: f64 = (0..D)
            .map(|k| self.precision[k] * coefficients[k] * coefficients[k])
            .sum();
        vector::dot(&self.linear, coefficients) + self.constant - 0.5 * prior
    }
}

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
