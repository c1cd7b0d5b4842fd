//! The squared maximum mean discrepancy with the Gaussian kernel, between clouds and against a fixed reference.

use crate::error::finite;
use crate::lanes::{Lanes, negative_exponential};
use crate::pair_sum::{OfDistance, Packed, PackedWeights, cross_sum, symmetric_sum};
use crate::{Cloud, MetricError, RadialKernel};

const NAME: &str = "the maximum mean discrepancy";

/// k(x_i, y_j) = exp(−|x_i − y_j|² rate).
fn pairs<'a, const D: usize>(
    kernel: &RadialKernel,
    cloud: &'a Cloud<'_, D>,
    columns: &'a Packed<D>,
) -> OfDistance<'a, impl Fn(Lanes) -> Lanes, D> {
    let rate = kernel.rate();
    OfDistance {
        rows: cloud.points(),
        columns,
        function: move |squares: Lanes| negative_exponential(&squares.map(|square| square * rate)),
    }
}

/// Σ_ij w_i w_j k(x_i, x_j), the diagonal included.
pub(crate) fn mean_kernel<const D: usize>(cloud: &Cloud<'_, D>, kernel: &RadialKernel) -> f64 {
    let points = Packed::new(cloud.points());
    symmetric_sum(&pairs(kernel, cloud, &points), &PackedWeights::new(cloud))
}

/// The squared maximum mean discrepancy between two clouds, both as they are (V-statistics):
///
/// MMD² = Σ_ij w_i w_j k(x_i, x_j) + Σ_ij u_i u_j k(y_i, y_j) − 2 Σ_ij w_i u_j k(x_i, y_j) ≥ 0,
///
/// symmetric, without unit, zero only if the two weighted clouds are the same measure; what rounding takes below 0 is 0. If `second` is a sample that
/// stands for a distribution, use [`DiscrepancyReference`]. O((M + N)²), in parallel and independent of the number of
/// threads.
///
/// Source: A. Gretton, K. Borgwardt, M. Rasch, B. Schölkopf, A. Smola, *A kernel two-sample test*, JMLR 13, 2012,
/// Eq. (5).
///
/// # Errors
/// [`MetricError::Overflow`] if a term is not finite.
pub fn maximum_mean_discrepancy_squared<const D: usize>(
    first: &Cloud<'_, D>,
    second: &Cloud<'_, D>,
    kernel: &RadialKernel,
) -> Result<f64, MetricError> {
    let points = Packed::new(second.points());
    let function = pairs(kernel, first, &points);
    let cross = cross_sum(&function, &PackedWeights::new(first), &PackedWeights::new(second));
    let value = mean_kernel(first, kernel) + mean_kernel(second, kernel) - 2.0 * cross;
    Ok(finite(NAME, value)?.max(0.0))
}

/// A reference sample y_1…y_N ~ p, prepared once and compared with many clouds: its own term is the U-statistic
/// Σ_{i≠j} u_i u_j k(y_i, y_j) / (1 − Σ u_j²), unbiased for E k(Y, Y') (Gretton et al. 2012, Lemma 6); the cloud's is the
/// V-statistic. M independent particles then have the expectation (1 − E k(Y, Y')) / M; small values may be negative.
#[derive(Clone, Debug)]
pub struct DiscrepancyReference<const D: usize> {
    kernel: RadialKernel,
    mean_kernel: f64,
    points: Packed<D>,
    weights: PackedWeights,
}

impl<const D: usize> DiscrepancyReference<D> {
    /// Copies the reference and computes its own term, O(N²).
    ///
    /// # Errors
    /// [`MetricError::TooFewPoints`] unless two points have positive weight.
    pub fn new(reference: &Cloud<'_, D>, kernel: RadialKernel) -> Result<Self, MetricError> {
        let share = reference.distinct_pair_share("the mean kernel of a reference sample")?;
        let distinct = mean_kernel(reference, &kernel) - reference.squared_weight_sum();
        let (points, weights) = (Packed::new(reference.points()), PackedWeights::new(reference));
        Ok(Self {
            kernel,
            mean_kernel: finite(NAME, distinct / share)?,
            points,
            weights,
        })
    }

    /// The unbiased estimate of E k(Y, Y').
    pub fn mean_kernel(&self) -> f64 {
        self.mean_kernel
    }

    /// The squared maximum mean discrepancy of a cloud from the reference, O(M (M/2 + N)).
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a term is not finite.
    pub fn squared(&self, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
        let function = pairs(&self.kernel, cloud, &self.points);
        let cross = cross_sum(&function, &PackedWeights::new(cloud), &self.weights);
        finite(NAME, mean_kernel(cloud, &self.kernel) + self.mean_kernel - 2.0 * cross)
    }
}
