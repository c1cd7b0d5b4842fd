//! A correlated Gaussian whose axes have scales from a thousandth to a thousand.

use mpm_tensor::Matrix;

use crate::error::at_least_two;
use crate::{Gaussian, TargetError};

/// log₁₀ of the largest standard deviation, and of the inverse of the smallest.
const DECADES: f64 = 3.0;

impl<const D: usize> Gaussian<D> {
    /// `scales`: N(0, C) with C_ij = s_i s_j R^|i−j|, s_i = 10^(−3 + 6 (i−1)/(D−1)) for i = 1 … D, R = `correlation`.
    ///
    /// The standard deviations run from 10⁻³ to 10³ in equal ratios, so the ratio of the largest to the smallest scale is
    /// 10⁶, and the condition number of C, in squared units, at least 10¹². In its own frame the density is a standard normal
    /// one; it tests whoever has to find that frame.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2; [`TargetError::NotFinite`], or [`TargetError::OutOfRange`] unless
    /// −1 < R < 1.
    pub fn scales(correlation: f64) -> Result<Self, TargetError> {
        at_least_two("scales", D)?;
        let correlations = Self::autoregression(correlation)?;
        let scale: [f64; D] =
            std::array::from_fn(|axis| 10_f64.powf(DECADES * (2.0 * axis as f64 / (D as f64 - 1.0) - 1.0)));
        let covariance = Matrix::from_fn(|i, j| scale[i] * scale[j] * correlations.0[i][j]);
        Self::named("scales", [0.0; D], covariance)
    }
}
