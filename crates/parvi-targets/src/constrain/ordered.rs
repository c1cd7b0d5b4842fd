//! Increasing coordinates, through the exponentials of their gaps.

use super::numbers::{exponential, inside};
use super::transform::{OutsideSupport, Transform, check_each};

/// x₁ = y₁, x_k = x_{k−1} + e^{y_k}, or above 0 x₁ = e^{y₁}; log |det J| = Σ y_k over the exponentials.
///
/// Source: Stan Reference Manual, "Constraint transforms": ordered vector, positive ordered vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ordered {
    pub count: usize,
    /// Whether x₁ is above 0.
    pub positive: bool,
}

impl Ordered {
    /// The coordinates in front that are no sum with an exponential.
    fn free(&self) -> usize {
        usize::from(!self.positive)
    }
}

impl Transform for Ordered {
    fn name(&self) -> &str {
        if self.positive { "positive ordered" } else { "ordered" }
    }

    fn constrained_dimension(&self) -> usize {
        self.count
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        let mut before = 0.0;
        for k in 0..self.count {
            x[k] = if k < self.free() {
                y[k]
            } else {
                inside(before + exponential(y[k]), [before, f64::INFINITY])
            };
            before = x[k];
        }
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        y[self.free()..].iter().sum()
    }

    /// y_k moves all coordinates from x_k on: (Jᵀ s)_k = e^{y_k} Σ_{j≥k} s_j.
    fn pull_back(&self, y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        let mut tail = 0.0;
        for k in (0..self.count).rev() {
            tail += score[k];
            out[k] = if k < self.free() {
                tail
            } else {
                exponential(y[k]) * tail + 1.0
            };
        }
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        let allowed = if self.positive {
            "a finite number above the one before and above 0"
        } else {
            "a finite number above the one before"
        };
        let before = |k: usize| if k == 0 { 0.0 } else { x[k - 1] };
        check_each(x, allowed, |k, value| {
            value.is_finite() && (k < self.free() || value > before(k))
        })?;
        for k in 0..self.count {
            y[k] = if k < self.free() { x[k] } else { (x[k] - before(k)).ln() };
        }
        Ok(())
    }
}
