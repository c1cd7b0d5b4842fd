//! Coordinates above or below a bound, through the exponential.

use super::numbers::{exponential, inside};
use super::transform::{OutsideSupport, Transform, check_each};

/// x = a + e^y above the bound a, or x = a − e^y below it, on every coordinate; log |det J| = Σ y, its gradient 1.
///
/// Source: Stan Reference Manual, "Constraint transforms": lower bounded and upper bounded scalar.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfLine {
    pub name: &'static str,
    pub count: usize,
    /// a, finite.
    pub bound: f64,
    pub side: Side,
}

/// Where the coordinates are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Above,
    Below,
}

impl HalfLine {
    fn sign(&self) -> f64 {
        match self.side {
            Side::Above => 1.0,
            Side::Below => -1.0,
        }
    }

    fn support(&self) -> [f64; 2] {
        match self.side {
            Side::Above => [self.bound, f64::INFINITY],
            Side::Below => [f64::NEG_INFINITY, self.bound],
        }
    }
}

impl Transform for HalfLine {
    fn name(&self) -> &str {
        self.name
    }

    fn constrained_dimension(&self) -> usize {
        self.count
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        for (x, &y) in x.iter_mut().zip(y) {
            *x = inside(self.bound + self.sign() * exponential(y), self.support());
        }
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        y.iter().sum()
    }

    fn pull_back(&self, y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        for ((out, &y), &score) in out.iter_mut().zip(y).zip(score) {
            *out = self.sign() * exponential(y) * score + 1.0;
        }
    }

    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        let (sign, bound) = (self.sign(), self.bound);
        let allowed = match self.side {
            Side::Above => "a finite number above the bound",
            Side::Below => "a finite number below the bound",
        };
        check_each(x, allowed, |_, x| x.is_finite() && sign * x > sign * bound)?;
        for (y, &x) in y.iter_mut().zip(x) {
            *y = (sign * (x - bound)).ln();
        }
        Ok(())
    }
}
