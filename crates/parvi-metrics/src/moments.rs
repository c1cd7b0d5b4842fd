//! Moments and quantiles of a cloud, and how far they are from the truth.

use mpm_tensor::Matrix;
use parvi_targets::Moments;

use crate::error::{entries, finite};
use crate::sorted::SortedSample;
use crate::summation::sum;
use crate::{Cloud, MetricError};

const NAME: &str = "the moments of the cloud";

/// The moments of a cloud as a measure: sums over Σ_p w_p = 1, without a correction for the size of the sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudMoments<const D: usize> {
    /// x̄ = Σ_p w_p x_p.
    pub mean: [f64; D],
    /// Σ_p w_p (x_p − x̄)(x_p − x̄)ᵀ, exactly symmetric.
    pub covariance: Matrix<D>,
    /// The roots of the diagonal of the covariance.
    pub standard_deviation: [f64; D],
    /// Σ_p w_p ((x_p − x̄)/sd)³ per axis; 0 for a symmetric cloud, NaN on an axis without spread.
    pub skewness: [f64; D],
    /// Σ_p w_p ((x_p − x̄)/sd)⁴ per axis; 3 for a Gaussian, NaN on an axis without spread.
    pub kurtosis: [f64; D],
}

impl<const D: usize> CloudMoments<D> {
    /// The moments of a cloud, by compensated sums about the mean: O(M D²).
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a squared coordinate exceeds the range of `f64`.
    pub fn new(cloud: &Cloud<'_, D>) -> Result<Self, MetricError> {
        let mut mean = [0.0; D];
        for axis in 0..D {
            let values = cloud.iter().filter(|(_, weight)| *weight > 0.0).map(|(x, _)| x[axis]);
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (x.min(low), x.max(high))
            });
            let average = finite(NAME, sum(cloud.iter().map(|(point, weight)| weight * point[axis])))?;
            // Rounding may take the mean beyond the points: of equal ones it would be another number, and they would have a spread.
            mean[axis] = average.max(low).min(high);
        }
        let mut covariance = Matrix([[0.0; D]; D]);
        for i in 0..D {
            for j in 0..=i {
                let products = cloud
                    .iter()
                    .map(|(x, weight)| weight * ((x[i] - mean[i]) * (x[j] - mean[j])));
                covariance.0[i][j] = finite(NAME, sum(products))?;
                covariance.0[j][i] = covariance.0[i][j];
            }
        }
        let standard_deviation: [f64; D] = std::array::from_fn(|axis| covariance.0[axis][axis].sqrt());
        let standardised = |power| {
            std::array::from_fn(|axis| {
                let scaled = |x: &[f64; D]| ((x[axis] - mean[axis]) / standard_deviation[axis]).powi(power);
                sum(cloud.iter().map(|(x, weight)| weight * scaled(x)))
            })
        };
        let (skewness, kurtosis) = (standardised(3), standardised(4));
        Ok(Self {
            mean,
            covariance,
            standard_deviation,
            skewness,
            kurtosis,
        })
    }

    /// Mean and covariance, in the form in which targets state theirs.
    pub fn moments(&self) -> Moments<D> {
        Moments {
            mean: self.mean,
            covariance: self.covariance,
        }
    }
}

/// The quantiles of every coordinate at the given levels: `result[k][axis]` for `levels[k]`.
///
/// The quantile of level q is the value at which the distribution function of the weighted points passes q; where it
/// equals q along a gap, the middle of the gap. So the median of an even number of points is the usual one.
///
/// Source: R. J. Hyndman, Y. Fan, *Sample quantiles in statistical packages*, Am. Stat. 50, 1996, definition 2.
///
/// # Errors
/// [`MetricError::InvalidEntry`] for a level outside \[0, 1\].
pub fn quantiles<const D: usize>(cloud: &Cloud<'_, D>, levels: &[f64]) -> Result<Vec<[f64; D]>, MetricError> {
    let is_level = |level: f64| (0.0..=1.0).contains(&level);
    entries("the level of quantile", levels, is_level, "between 0 and 1")?;
    let mut result = vec![[0.0; D]; levels.len()];
    for axis in 0..D {
        let sample = SortedSample::along_axis(cloud, axis);
        for (row, level) in result.iter_mut().zip(levels) {
            row[axis] = sample.quantile(*level);
        }
    }
    Ok(result)
}

/// The error of a cloud's moments in units of the reference's standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentError<const D: usize> {
    /// |x̄ − m| / sd_ref per axis.
    pub mean: [f64; D],
    /// sd / sd_ref − 1 per axis.
    pub standard_deviation: [f64; D],
    /// The largest entry of [`mean`](Self::mean).
    pub largest_mean: f64,
    /// The largest |sd / sd_ref − 1|.
    pub largest_standard_deviation: f64,
    /// max_ij |C_ij − C_ref,ij| / (sd_ref,i sd_ref,j).
    pub largest_covariance: f64,
}

impl<const D: usize> MomentError<D> {
    /// The error of a cloud's moments against `reference`.
    ///
    /// Independent draws have mean errors of about 1/√M and standard-deviation errors of about 1/√(2M) (Gaussian).
    ///
    /// # Errors
    /// Those of [`CloudMoments::new`]; [`MetricError::InvalidEntry`] for a reference mean that is not finite,
    /// [`MetricError::InvalidCovariance`] for a reference variance that is not positive and finite.
    pub fn new(cloud: &Cloud<'_, D>, reference: &Moments<D>) -> Result<Self, MetricError> {
        let scale = checked_scale(reference)?;
        let found = CloudMoments::new(cloud)?;
        let mean = std::array::from_fn(|axis| (found.mean[axis] - reference.mean[axis]).abs() / scale[axis]);
        let standard_deviation = std::array::from_fn(|axis| found.standard_deviation[axis] / scale[axis] - 1.0);
        let mut largest_covariance: f64 = 0.0;
        for i in 0..D {
            for j in 0..D {
                let difference = found.covariance.0[i][j] - reference.covariance.0[i][j];
                largest_covariance = largest_covariance.max((difference / scale[i] / scale[j]).abs());
            }
        }
        let largest = |values: &[f64; D]| values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let (largest_mean, largest_standard_deviation) = (largest(&mean), largest(&standard_deviation));
        Ok(Self {
            mean,
            standard_deviation,
            largest_mean,
            largest_standard_deviation,
            largest_covariance,
        })
    }
}

/// The standard deviations of a reference whose mean and variances are usable.
pub(crate) fn checked_scale<const D: usize>(reference: &Moments<D>) -> Result<[f64; D], MetricError> {
    entries("reference mean", &reference.mean, f64::is_finite, "finite")?;
    let variance: [f64; D] = std::array::from_fn(|axis| reference.covariance.0[axis][axis]);
    match variance.iter().find(|value| !(value.is_finite() && **value > 0.0)) {
        Some(&value) => Err(MetricError::InvalidCovariance {
            reason: "it has the variance",
            value,
        }),
        None => Ok(variance.map(f64::sqrt)),
    }
}
