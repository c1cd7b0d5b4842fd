//! The Cholesky factor of a correlation matrix from canonical partial correlations.
//!
//! z_ij = tanh y_ij for j < i, row by row; L_ij = z_ij r_ij with r_ij = Π_{k<j} (1 − z_ik²)^½, and L_ii = r_ii. Rows of L have
//! norm one, so L Lᵀ is a correlation matrix. Rows and columns are counted from 0.
//!
//! Source: Lewandowski, Kurowicka & Joe, *Generating random correlation matrices based on vines and extended onion method*,
//! J. Multivar. Anal. 100 (2009); Stan Reference Manual, "Constraint transforms": Cholesky factors of correlation matrices.

use super::numbers::{SMALLEST, at_least, hyperbolic_secant, log_one_minus_tanh_squared};
use super::transform::OutsideSupport;

/// How far the norm of a row may be from one.
const TOLERANCE: f64 = 1e-9;

/// Entries of the lower triangle of a matrix of `size` rows: without its diagonal.
pub(crate) fn entries_below_diagonal(size: usize) -> usize {
    size * size.saturating_sub(1) / 2
}

/// Entries of the lower triangle of a matrix of `size` rows: with its diagonal.
pub(crate) fn entries_of_triangle(size: usize) -> usize {
    entries_below_diagonal(size) + size
}

/// `list`\[row i\] of a strict lower triangle stored row by row.
pub(crate) fn strict_row(list: &[f64], i: usize) -> &[f64] {
    let start = entries_below_diagonal(i);
    &list[start..start + i]
}

/// `list`\[row i\] of a lower triangle stored row by row.
pub(crate) fn row(list: &[f64], i: usize) -> &[f64] {
    let start = entries_of_triangle(i);
    &list[start..=start + i]
}

/// `factor` = L of `y`; the diagonal is at least e^−700.
pub(crate) fn factor(size: usize, y: &[f64], factor: &mut [f64]) {
    for i in 0..size {
        let mut rest = 1.0;
        let start = entries_of_triangle(i);
        for (j, &y) in strict_row(y, i).iter().enumerate() {
            factor[start + j] = y.tanh() * rest;
            rest *= hyperbolic_secant(y);
        }
        factor[start + i] = at_least(SMALLEST, rest);
    }
}

/// Σ_{i>j} c_ij log(1 − z_ij²), what the logarithms of the determinants come to, with c_ij = `coefficient(i, j)`.
pub(crate) fn log_jacobian(size: usize, y: &[f64], coefficient: impl Fn(usize, usize) -> f64) -> f64 {
    let mut sum = 0.0;
    for i in 0..size {
        for (j, &y) in strict_row(y, i).iter().enumerate() {
            sum += coefficient(i, j) * log_one_minus_tanh_squared(y);
        }
    }
    sum
}

/// `out` = (∂L/∂y)ᵀ s + ∇ Σ c_ij log(1 − z_ij²), with s = `score` a derivative per entry of the factor L.
///
/// y_ij moves L_ij at the rate (1 − z_ij²) r_ij, and the later entries of its row at −z_ij L_ik.
pub(crate) fn pull_back(
    size: usize,
    y: &[f64],
    factor: &[f64],
    score: &[f64],
    coefficient: impl Fn(usize, usize) -> f64,
    out: &mut [f64],
) {
    for i in 0..size {
        let (y, factor, score) = (strict_row(y, i), row(factor, i), row(score, i));
        let start = entries_below_diagonal(i);
        let out = &mut out[start..start + i];
        let mut rest = 1.0;
        for j in 0..i {
            let secant = hyperbolic_secant(y[j]);
            out[j] = secant * secant * rest;
            rest *= secant;
        }
        let mut later = score[i] * factor[i];
        for j in (0..i).rev() {
            out[j] = score[j] * out[j] - y[j].tanh() * (later + 2.0 * coefficient(i, j));
            later += score[j] * factor[j];
        }
    }
}

/// `y` of a factor: sinh y_ij = L_ij / r_{i,j+1}, with r_{i,j+1} the norm of what follows in the row.
pub(crate) fn unconstrain(size: usize, factor: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
    for i in 0..size {
        let entries = row(factor, i);
        let outside = |allowed| OutsideSupport {
            coordinate: entries_of_triangle(i) + i,
            value: entries[i],
            allowed,
        };
        let start = entries_below_diagonal(i);
        let mut rest = entries[i];
        if rest.is_nan() || rest <= 0.0 {
            return Err(outside("a diagonal entry above 0"));
        }
        for j in (0..i).rev() {
            y[start + j] = (entries[j] / rest).asinh();
            rest = rest.hypot(entries[j]);
        }
        if rest.is_nan() || (rest - 1.0).abs() > TOLERANCE {
            return Err(outside("what makes the norm of its row 1"));
        }
    }
    Ok(())
}
