//! Coordinates without a constraint.

use super::transform::{OutsideSupport, Transform, check_each};

/// x = y on every coordinate; log |det J| = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Free {
    pub count: usize,
}

impl Transform for Free {
    fn name(&self) -> &str {
        "free"
    }

    fn constrained_dimension(&self) -> usize {
        self.count
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        x.copy_from_slice(y);
    }

    fn log_jacobian(&self, _y: &[f64], _x: &[f64]) -> f64 {
        0.0
    }

    fn pull_back(&self, _y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        out.copy_from_slice(score);
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        check_each(x, "a finite number", |_, x| x.is_finite())?;
        y.copy_from_slice(x);
        Ok(())
    }
}
