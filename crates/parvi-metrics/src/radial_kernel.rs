//! The Gaussian (radial basis function) kernel and its median bandwidth.

use crate::error::{finite, parameter};
use crate::sorted::SortedSample;
use crate::{Cloud, MetricError};

const NAME: &str = "the median of the positive distances";

/// Points that the median heuristic looks at, at most; the median of their half a million distances is known well enough.
const MEDIAN_POINTS: usize = 1024;

/// The kernel k(x, y) = exp(−|x − y|² / 2b²) with bandwidth b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialKernel {
    bandwidth: f64,
}

impl RadialKernel {
    /// The kernel with bandwidth b, a length.
    ///
    /// # Errors
    /// [`MetricError::InvalidParameter`] unless 1e-150 < b < 1e150.
    pub fn new(bandwidth: f64) -> Result<Self, MetricError> {
        let is_usable = bandwidth > 1e-150 && bandwidth < 1e150;
        parameter(
            "the bandwidth of the kernel",
            bandwidth,
            is_usable,
            "between 1e-150 and 1e150",
        )?;
        Ok(Self { bandwidth })
    }

    /// The kernel whose bandwidth is the median of the positive distances between the points of a cloud, each pair with
    /// the product of its weights. Of more than 1024 points, 1024 equally spaced in the cumulated weight stand for all.
    ///
    /// Take the bandwidth of the reference and keep it: values with different bandwidths cannot be compared.
    ///
    /// Source: Gretton et al. 2012 (as for
    /// [`maximum_mean_discrepancy_squared`](crate::maximum_mean_discrepancy_squared)), §8.
    ///
    /// # Errors
    /// [`MetricError::TooFewPoints`] unless two distinct points have positive weight, [`MetricError::InvalidParameter`]
    /// for a median outside the range of [`RadialKernel::new`], [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
    pub fn median_heuristic<const D: usize>(cloud: &Cloud<'_, D>) -> Result<Self, MetricError> {
        let (points, weights) = thinned(cloud);
        let (mut distances, mut products) = (Vec::new(), Vec::new());
        for (i, x) in points.iter().enumerate() {
            for (j, y) in points[..i].iter().enumerate() {
                let distance = finite(NAME, mpm_tensor::vector::distance(x, y))?;
                let product = weights[i] * weights[j];
                if distance > 0.0 && product > 0.0 {
                    distances.push([distance]);
                    products.push(product);
                }
            }
        }
        let too_few = MetricError::TooFewPoints { statistic: NAME };
        let cloud = Cloud::weighted(&distances, &products)
            .map_err(|error| if error == MetricError::Empty { too_few } else { error })?;
        Self::new(SortedSample::along_axis(&cloud, 0).quantile(0.5))
    }

    /// The bandwidth b.
    pub fn bandwidth(&self) -> f64 {
        self.bandwidth
    }

    /// 1 / 2b².
    pub(crate) fn rate(&self) -> f64 {
        0.5 / (self.bandwidth * self.bandwidth)
    }
}

/// The points themselves, or equally weighted ones at the levels (k + ½)/n of the cumulated weight.
fn thinned<const D: usize>(cloud: &Cloud<'_, D>) -> (Vec<[f64; D]>, Vec<f64>) {
    if cloud.len() <= MEDIAN_POINTS {
        return cloud.iter().map(|(point, weight)| (*point, weight)).unzip();
    }
    let mut points = Vec::with_capacity(MEDIAN_POINTS);
    let mut cumulated = 0.0;
    for (point, weight) in cloud.iter() {
        cumulated += weight;
        while points.len() < MEDIAN_POINTS && (points.len() as f64 + 0.5) / (MEDIAN_POINTS as f64) < cumulated {
            points.push(*point);
        }
    }
    let weights = vec![1.0; points.len()];
    (points, weights)
}
