//! The Gaussian density with any mean and covariance.

use mpm_tensor::Matrix;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::error::{finite, within};
use crate::special::{HALF_LOG_TWO_PI, normal_quantile};
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// N(μ, C): log p(x) = −½ (x−μ)ᵀ C⁻¹ (x−μ) − ½ log det C − D/2 · log 2π (normalised), score −C⁻¹ (x−μ).
///
/// With C = L Lᵀ everything is a triangular solve: z = L⁻¹ (x−μ), log p = −½|z|² + const, score = −L⁻ᵀ z.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian<const D: usize> {
    name: &'static str,
    frame: Frame<D>,
    covariance: Matrix<D>,
    log_normalisation: f64,
}

impl<const D: usize> Gaussian<D> {
    /// N(`mean`, `covariance`).
    ///
    /// # Errors
    /// As [`Frame::new`]: not finite, not symmetric or not positive definite.
    pub fn new(mean: [f64; D], covariance: Matrix<D>) -> Result<Self, TargetError> {
        Self::named("gaussian", mean, covariance)
    }

    /// As [`new`](Self::new), under another name of the catalogue.
    pub(crate) fn named(name: &'static str, mean: [f64; D], covariance: Matrix<D>) -> Result<Self, TargetError> {
        let frame = Frame::new(mean, covariance)?;
        Ok(Self::from_frame(name, frame, covariance))
    }

    /// N(0, I).
    pub fn standard() -> Self {
        let frame = Frame::identity();
        Self::from_frame("gaussian", frame, *frame.factor())
    }

    /// N(0, C) with C_ij = R^|i−j|, the covariance of a stationary first-order autoregression (R = `correlation`).
    ///
    /// # Errors
    /// [`TargetError::NotFinite`], or [`TargetError::OutOfRange`] unless −1 < R < 1.
    pub fn autoregressive(correlation: f64) -> Result<Self, TargetError> {
        Self::new([0.0; D], Self::autoregression(correlation)?)
    }

    /// The matrix R^|i−j|.
    pub(crate) fn autoregression(correlation: f64) -> Result<Matrix<D>, TargetError> {
        finite("correlation", correlation)?;
        let allowed = "a number between -1 and 1, both excluded";
        within("correlation", correlation, correlation.abs() < 1.0, allowed)?;
        Ok(Matrix::from_fn(|i, j| correlation.powi(i.abs_diff(j) as i32)))
    }

    fn from_frame(name: &'static str, frame: Frame<D>, covariance: Matrix<D>) -> Self {
        let log_normalisation = -frame.log_determinant() - D as f64 * HALF_LOG_TWO_PI;
        Self {
            name,
            frame,
            covariance,
            log_normalisation,
        }
    }
}

impl<const D: usize> Target<D> for Gaussian<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let z = self.frame.to_reference(x);
        self.log_normalisation - 0.5 * z.iter().map(|z| z * z).sum::<f64>()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let z = self.frame.to_reference(x);
        self.frame.push_forward_score(&z.map(|z| -z))
    }
}

impl<const D: usize> ExactDraws<D> for Gaussian<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.frame.to_target(&standard_normal(rng))
    }
}

impl<const D: usize> UnitCubeTransport<D> for Gaussian<D> {
    fn transport(&self, u: &[f64]) -> [f64; D] {
        self.frame.to_target(&normal_quantiles(u))
    }
}

impl<const D: usize> CatalogueTarget<D> for Gaussian<D> {
    fn name(&self) -> &str {
        self.name
    }

    fn frame(&self) -> Frame<D> {
        self.frame
    }

    fn domain(&self) -> [[f64; 2]; D] {
        box_of_standard_deviations(self.frame.centre(), &self.covariance, 4.0)
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        Some(Moments {
            mean: *self.frame.centre(),
            covariance: self.covariance,
        })
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}

/// A draw from N(0, I).
pub(crate) fn standard_normal<const D: usize>(rng: &mut dyn Rng) -> [f64; D] {
    std::array::from_fn(|_| StandardNormal.sample(rng))
}

/// Φ⁻¹ of the first `D` entries of `u` (½ where there are fewer).
pub(crate) fn normal_quantiles<const D: usize>(u: &[f64]) -> [f64; D] {
    std::array::from_fn(|axis| u.get(axis).map_or(0.0, |&u| normal_quantile(u)))
}

/// `centre` ± `count` standard deviations per axis.
pub(crate) fn box_of_standard_deviations<const D: usize>(
    centre: &[f64; D],
    covariance: &Matrix<D>,
    count: f64,
) -> [[f64; 2]; D] {
    std::array::from_fn(|axis| {
        let half = count * covariance.0[axis][axis].sqrt();
        [centre[axis] - half, centre[axis] + half]
    })
}
