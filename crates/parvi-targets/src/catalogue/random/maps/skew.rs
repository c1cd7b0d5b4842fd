//! Skewness and weight of tails along one coordinate.

use super::distinct_axes;
use crate::error::{finite, positive};
use crate::special::log_cosh;
use crate::{Bijection, TargetError};

/// The sinh-arcsinh map x_k = sinh t, t = (arsinh y_k + ε) / δ: ε > 0 skews to the right, δ < 1 makes tails heavier
/// (|x| ~ |y|^(1/δ)), δ > 1 lighter. log|det J| = log cosh t − log δ − ½ log(1 + y_k²).
///
/// Source: M. C. Jones, A. Pewsey, Sinh-arcsinh distributions, *Biometrika* 96 (2009) 761–780.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Skew {
    axis: usize,
    skewness: f64,
    lightness: f64,
}

impl Skew {
    /// The map of ℝᴰ with k = `axis`, ε = `skewness`, δ = `lightness`.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] unless k is below D and δ > 0; [`TargetError::NotFinite`].
    pub fn new<const D: usize>(axis: usize, skewness: f64, lightness: f64) -> Result<Self, TargetError> {
        distinct_axes::<D>(&[axis])?;
        Ok(Self {
            axis,
            skewness: finite("a skewness", skewness)?,
            lightness: positive("a lightness of tails", lightness)?,
        })
    }

    /// t.
    fn stretched(&self, y: f64) -> f64 {
        (y.asinh() + self.skewness) / self.lightness
    }

    fn log_slope(&self, y: f64) -> f64 {
        log_cosh(self.stretched(y)) - self.lightness.ln() - 1.0_f64.hypot(y).ln()
    }
}

impl<const D: usize> Bijection<D> for Skew {
    fn forward(&self, y: &[f64; D]) -> [f64; D] {
        let mut x = *y;
        x[self.axis] = self.stretched(y[self.axis]).sinh();
        x
    }

    fn inverse(&self, x: &[f64; D]) -> [f64; D] {
        let mut y = *x;
        y[self.axis] = (self.lightness * x[self.axis].asinh() - self.skewness).sinh();
        y
    }

    fn log_determinant(&self, y: &[f64; D]) -> f64 {
        self.log_slope(y[self.axis])
    }

    fn log_determinant_gradient(&self, y: &[f64; D]) -> [f64; D] {
        let at = y[self.axis];
        let root = 1.0_f64.hypot(at);
        let mut gradient = [0.0; D];
        gradient[self.axis] = self.stretched(at).tanh() / (self.lightness * root) - at / root / root;
        gradient
    }

    fn push_gradient(&self, y: &[f64; D], gradient: &[f64; D]) -> [f64; D] {
        let mut pushed = *gradient;
        pushed[self.axis] *= (-self.log_slope(y[self.axis])).exp();
        pushed
    }
}
