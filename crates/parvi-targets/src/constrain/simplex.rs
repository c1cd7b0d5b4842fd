//! Probabilities that sum to one, through isometric log ratios.

use super::numbers::{SMALLEST, at_least};
use super::transform::{OutsideSupport, Transform, check_each};

/// How far the sum of probabilities may be from one.
const TOLERANCE: f64 = 1e-9;

/// x = softmax(V y), with the K × (K−1) matrix V of orthonormal columns that sum to zero (Helmert's):
/// V_ij = w_j for i ≤ j, V_{j+1,j} = −(j+1) w_j, w_j = ((j+1)(j+2))^−½, counted from 0.
///
/// In the first K − 1 coordinates log |det J| = Σ_k log x_k + ½ log K, its gradient −K Vᵀ x; and
/// (∂x/∂y)ᵀ s = Vᵀ (x ∘ (s − x·s)). Permuting x turns y rigidly, so no coordinate is preferred.
///
/// Source: Egozcue, Pawlowsky-Glahn, Mateu-Figueras & Barceló-Vidal, *Isometric logratio transformations for compositional
/// data analysis*, Math. Geol. 35 (2003); Stan Reference Manual, "Constraint transforms": unit simplex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex {
    /// K ≥ 2.
    pub count: usize,
}

/// w_j.
fn weight(j: usize) -> f64 {
    let j = j as f64;
    ((j + 1.0) * (j + 2.0)).sqrt().recip()
}

/// z_i = (V y)_i, given `tail` = Σ_{j≥i} w_j y_j.
fn logit(y: &[f64], i: usize, tail: f64) -> f64 {
    if i == 0 {
        tail
    } else {
        tail - i as f64 * weight(i - 1) * y[i - 1]
    }
}

/// `out` = Vᵀ g with g_i = `entry(i)`.
fn transposed(entry: impl Fn(usize) -> f64, out: &mut [f64]) {
    let mut sum = 0.0;
    for j in 0..out.len() {
        sum += entry(j);
        out[j] = weight(j) * (sum - (j + 1) as f64 * entry(j + 1));
    }
}

impl Transform for Simplex {
    fn name(&self) -> &str {
        "simplex"
    }

    fn constrained_dimension(&self) -> usize {
        self.count
    }

    fn unconstrained_dimension(&self) -> usize {
        self.count - 1
    }

    /// The first K − 1.
    fn independent_coordinates(&self) -> Vec<usize> {
        (0..self.count - 1).collect()
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        let mut tail = 0.0;
        let mut largest = f64::NEG_INFINITY;
        for i in (0..self.count).rev() {
            if i < y.len() {
                tail += weight(i) * y[i];
            }
            x[i] = logit(y, i, tail);
            largest = largest.max(x[i]);
        }
        let mut sum = 0.0;
        for x in &mut *x {
            *x = (*x - largest).exp();
            sum += *x;
        }
        for x in x {
            *x = at_least(SMALLEST, *x / sum);
        }
    }

    /// Σ_k log x_k = −K log Σ e^{z_k}, since Σ z = 0; the logarithm is z_i − log x_i for the largest x_i.
    fn log_jacobian(&self, y: &[f64], x: &[f64]) -> f64 {
        let largest = (1..self.count).fold(0, |best, i| if x[i] > x[best] { i } else { best });
        let tail = (largest..y.len()).rev().map(|j| weight(j) * y[j]).sum();
        let log_sum = logit(y, largest, tail) - x[largest].ln();
        let count = self.count as f64;
        0.5 * count.ln() - count * log_sum
    }

    fn pull_back(&self, _y: &[f64], x: &[f64], score: &[f64], out: &mut [f64]) {
        let mean: f64 = x.iter().zip(score).map(|(x, s)| x * s).sum();
        let count = self.count as f64;
        transposed(|i| x[i] * (score[i] - mean - count), out);
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        check_each(x, "a probability above 0", |_, x| x > 0.0)?;
        let last = self.count - 1;
        let rest = 1.0 - x[..last].iter().sum::<f64>();
        check_each(x, "what the others leave of 1", |index, x| {
            index < last || (x - rest).abs() <= TOLERANCE
        })?;
        transposed(|i| x[i].ln(), y);
        Ok(())
    }
}
