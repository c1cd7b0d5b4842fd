//! The log posterior of a logistic regression and its derivatives at one point, straight from the definitions.
//!
//! All three read the signed rows (2y_i − 1) x_i, whose product with β is the margin t_i: the likelihood of a row is
//! σ(t_i) = 1 / (1 + e^−t_i) for either response, and nothing cancels. A flat prior has precision 0.

use mpm_tensor::{Matrix, vector};

use crate::special::log_one_plus_exp;

/// −Σ log(1 + e^−margin) − ½ Σ precision_k β_k².
pub(crate) fn log_posterior<const D: usize>(
    signed_rows: &[[f64; D]],
    precision: &[f64; D],
    coefficients: &[f64; D],
) -> f64 {
    // Partial sums: the rounding of a long sum grows with its length.
    let loss = |row: &[f64; D]| log_one_plus_exp(-vector::dot(row, coefficients));
    let likelihood: f64 = signed_rows
        .chunks(64)
        .map(|rows| rows.iter().map(loss).sum::<f64>())
        .sum();
    let prior: f64 = (0..D).map(|k| precision[k] * coefficients[k] * coefficients[k]).sum();
    -likelihood - 0.5 * prior
}

/// Σ (2y_i − 1) x_i σ(−margin_i) − precision β.
pub(crate) fn score<const D: usize>(
    signed_rows: &[[f64; D]],
    precision: &[f64; D],
    coefficients: &[f64; D],
) -> [f64; D] {
    let mut score: [f64; D] = std::array::from_fn(|k| -precision[k] * coefficients[k]);
    for row in signed_rows {
        let miss = 1.0 / (1.0 + vector::dot(row, coefficients).exp());
        vector::accumulate(&mut score, miss, row);
    }
    score
}

/// Σ σ(margin_i) σ(−margin_i) x_i x_iᵀ + diag(precision).
pub(crate) fn negative_hessian<const D: usize>(
    signed_rows: &[[f64; D]],
    precision: &[f64; D],
    coefficients: &[f64; D],
) -> Matrix<D> {
    let mut hessian = Matrix::diagonal(precision);
    for row in signed_rows {
        // e^−|t| / (1 + e^−|t|)², without cancellation in either tail.
        let small = (-vector::dot(row, coefficients).abs()).exp();
        let weight = small / ((1.0 + small) * (1.0 + small));
        for i in 0..D {
            vector::accumulate(&mut hessian.0[i], weight * row[i], row);
        }
    }
    hessian
}
