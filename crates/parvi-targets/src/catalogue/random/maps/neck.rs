//! A scale that depends on another coordinate, within bounds.

use super::distinct_axes;
use crate::error::{finite, positive};
use crate::{Bijection, TargetError};

/// x_k = y_k e^h, h = s tanh(y_j / w): the thickness along k goes from e^(−s) to e^s where y_j goes from −∞ to ∞, as in a
/// funnel, but within bounds. log|det J| = h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neck {
    source: usize,
    scaled: usize,
    log_scale: f64,
    width: f64,
}

impl Neck {
    /// The map of ℝᴰ with j = `source`, k = `scaled`, s = `log_scale`, w = `width`.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] unless j and k are different axes below D and w > 0; [`TargetError::NotFinite`].
    pub fn new<const D: usize>(source: usize, scaled: usize, log_scale: f64, width: f64) -> Result<Self, TargetError> {
        distinct_axes::<D>(&[source, scaled])?;
        Ok(Self {
            source,
            scaled,
            log_scale: finite("the logarithm of a scale", log_scale)?,
            width: positive("the width of a neck", width)?,
        })
    }

    /// h at y_j.
    fn exponent(&self, source: f64) -> f64 {
        self.log_scale * (source / self.width).tanh()
    }

    /// dh/dy_j.
    fn slope(&self, source: f64) -> f64 {
        let tanh = (source / self.width).tanh();
        self.log_scale / self.width * (1.0 - tanh) * (1.0 + tanh)
    }
}

impl<const D: usize> Bijection<D> for Neck {
    fn forward(&self, y: &[f64; D]) -> [f64; D] {
        let mut x = *y;
        x[self.scaled] *= self.exponent(y[self.source]).exp();
        x
    }

    fn inverse(&self, x: &[f64; D]) -> [f64; D] {
        let mut y = *x;
        y[self.scaled] *= (-self.exponent(x[self.source])).exp();
        y
    }

    fn log_determinant(&self, y: &[f64; D]) -> f64 {
        self.exponent(y[self.source])
    }

    fn log_determinant_gradient(&self, y: &[f64; D]) -> [f64; D] {
        let mut gradient = [0.0; D];
        gradient[self.source] = self.slope(y[self.source]);
        gradient
    }

    fn push_gradient(&self, y: &[f64; D], gradient: &[f64; D]) -> [f64; D] {
        let (j, k) = (self.source, self.scaled);
        let mut pushed = *gradient;
        pushed[k] *= (-self.exponent(y[j])).exp();
        pushed[j] -= y[k] * self.slope(y[j]) * gradient[k];
        pushed
    }
}
