//! Increasing coordinates, through the exponentials of their gaps.

use super::numbers::{exponential, inside};
use super::transform::{OutsideSupport, Transform, check_each};

/// x₁ = y₁, x_k = x_{k−1} + e^{y_k}; log |det J| = Σ_{k>1} y_k.
///
/// Source: Stan Reference Manual, "Constraint transforms": ordered vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ordered {
    pub count: usize,
}

impl Transform for Ordered {
    fn name(&self) -> &str {
        "ordered"
    }

    fn constrained_dimension(&self) -> usize {
        self.count
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        x[0] = y[0];
        for k in 1..self.count {
            x[k] = inside(x[k - 1] + exponential(y[k]), [x[k - 1], f64::INFINITY]);
        }
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        y[1..].iter().sum()
    }

    /// y_k moves all coordinates from x_k on: (Jᵀ s)_k = e^{y_k} Σ_{j≥k} s_j.
    fn pull_back(&self, y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        let mut tail = 0.0;
        for k in (1..self.count).rev() {
            tail += score[k];
            out[k] = exponential(y[k]) * tail + 1.0;
        }
        out[0] = tail + score[0];
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        check_each(x, "a finite number above the one before", |k, value| {
            value.is_finite() && (k == 0 || value > x[k - 1])
        })?;
        y[0] = x[0];
        for k in 1..self.count {
            y[k] = (x[k] - x[k - 1]).ln();
        }
        Ok(())
    }
}
