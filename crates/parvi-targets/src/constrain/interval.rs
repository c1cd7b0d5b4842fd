//! Coordinates between two bounds, through the logistic function.

use super::numbers::{decay, inside};
use super::transform::{OutsideSupport, Transform, check_each};

/// x = a + (b − a) σ(y) on every coordinate, σ(y) = 1 / (1 + e^−y).
///
/// log |det J| = Σ [log(b − a) − |y| − 2 log(1 + e^−|y|)], its gradient −tanh(y/2). x is computed from the nearer bound,
/// x = b − (b − a) σ(−y) for y > 0, so that nothing cancels at a bound of zero.
///
/// Source: Stan Reference Manual, "Constraint transforms": lower and upper bounded scalar.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub count: usize,
    /// a.
    pub lower: f64,
    /// b, above a; b − a is finite.
    pub upper: f64,
}

impl Transform for Interval {
    fn name(&self) -> &str {
        "bounded"
    }

    fn constrained_dimension(&self) -> usize {
        self.count
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        for (x, &y) in x.iter_mut().zip(y) {
            let e = decay(y);
            let distance = (self.upper - self.lower) * (e / (1.0 + e));
            let exact = if y < 0.0 {
                self.lower + distance
            } else {
                self.upper - distance
            };
            *x = inside(exact, [self.lower, self.upper]);
        }
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        let log_width = (self.upper - self.lower).ln();
        y.iter().map(|y| log_width - y.abs() - 2.0 * decay(*y).ln_1p()).sum()
    }

    fn pull_back(&self, y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        for ((out, &y), &score) in out.iter_mut().zip(y).zip(score) {
            let e = decay(y);
            let slope = (self.upper - self.lower) * (e / ((1.0 + e) * (1.0 + e)));
            *out = slope * score - (0.5 * y).tanh();
        }
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        let allowed = "a number between the bounds, and neither of them";
        check_each(x, allowed, |_, x| x > self.lower && x < self.upper)?;
        for (y, &x) in y.iter_mut().zip(x) {
            *y = (x - self.lower).ln() - (self.upper - x).ln();
        }
        Ok(())
    }
}
