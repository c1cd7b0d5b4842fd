//! Coordinates in which a target has mean zero and unit scale.

use mpm_tensor::{Cholesky, Matrix};
use parvi_targets::Moments;

use crate::MetricError;
use crate::moments::checked_scale;

/// The map x ↦ z = L⁻¹(x − m) for a target with mean m and covariance C: metrics that mix the axes (energy distance,
/// sliced W₂, kernels of one bandwidth) mean the same in z for every target.
#[derive(Clone, Copy, Debug)]
pub struct Standardiser<const D: usize> {
    mean: [f64; D],
    factor: Cholesky<D>,
}

impl<const D: usize> Standardiser<D> {
    /// L Lᵀ = C (Cholesky): z has the identity as covariance.
    ///
    /// # Errors
    /// [`MetricError::InvalidEntry`] for a mean that is not finite, [`MetricError::InvalidCovariance`] for a covariance
    /// that is not positive definite.
    pub fn whitening(moments: &Moments<D>) -> Result<Self, MetricError> {
        checked_scale(moments)?;
        Self::with_covariance(moments.mean, &moments.covariance)
    }

    /// L = diag(sd): every axis of z has unit variance, correlations stay.
    ///
    /// # Errors
    /// [`MetricError::InvalidEntry`] for a mean that is not finite, [`MetricError::InvalidCovariance`] for a variance that
    /// is not positive.
    pub fn per_axis(moments: &Moments<D>) -> Result<Self, MetricError> {
        checked_scale(moments)?;
        let variance = std::array::from_fn(|axis| moments.covariance.0[axis][axis]);
        Self::with_covariance(moments.mean, &Matrix::diagonal(&variance))
    }

    fn with_covariance(mean: [f64; D], covariance: &Matrix<D>) -> Result<Self, MetricError> {
        let invalid = |pivot| MetricError::InvalidCovariance {
            reason: "it has the Cholesky pivot",
            value: pivot,
        };
        Ok(Self {
            mean,
            factor: Cholesky::new(covariance).map_err(|error| invalid(error.pivot))?,
        })
    }

    /// z = L⁻¹(x − m).
    pub fn point(&self, x: &[f64; D]) -> [f64; D] {
        self.factor
            .solve_lower(&std::array::from_fn(|axis| x[axis] - self.mean[axis]))
    }

    /// [`Standardiser::point`] for every point.
    pub fn points(&self, points: &[[f64; D]]) -> Vec<[f64; D]> {
        points.iter().map(|x| self.point(x)).collect()
    }

    /// x = m + L z, the inverse of [`Standardiser::point`].
    pub fn original(&self, z: &[f64; D]) -> [f64; D] {
        let offset = self.factor.lower().apply(z);
        std::array::from_fn(|axis| self.mean[axis] + offset[axis])
    }

    /// The score in z: ∇_z log p = Lᵀ ∇_x log p.
    pub fn score(&self, score: &[f64; D]) -> [f64; D] {
        self.factor.lower().apply_transposed(score)
    }
}
