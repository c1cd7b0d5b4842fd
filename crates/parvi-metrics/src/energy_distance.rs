//! Squared energy distance between two clouds, and against a fixed reference sample.

use crate::error::finite;
use crate::lanes::Lanes;
use crate::pair_sum::{OfDistance, Packed, PackedWeights, cross_sum, symmetric_sum};
use crate::sorted::SortedSample;
use crate::{Cloud, MetricError};

const NAME: &str = "the energy distance";

/// |x_i − y_j|.
fn distance<'a, const D: usize>(
    cloud: &'a Cloud<'_, D>,
    columns: &'a Packed<D>,
) -> OfDistance<'a, impl Fn(Lanes) -> Lanes, D> {
    OfDistance {
        rows: cloud.points(),
        columns,
        function: |squares: Lanes| squares.map(f64::sqrt),
    }
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    /// Σ_ij w_i w_j ‖x_i − x_j‖.
    pair_distances: fn(&Cloud<'_, D>) -> f64,
    /// Σ_ij w_i u_j ‖x_i − y_j‖.
    cross_distances: fn(&Cloud<'_, D>, &Packed<D>, &PackedWeights) -> f64,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self {
        pair_distances,
        cross_distances,
    };
}

mpm_parallel::compiled_ahead!(Compiled);

/// E|x − x'| = Σ_ij w_i w_j |x_i − x_j| over a cloud (V-statistic: pairs i = j count, with distance 0).
///
/// O(M log M) in one dimension, O(M²) else, in parallel and independent of the number of threads.
///
/// # Errors
/// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
pub fn mean_pair_distance<const D: usize>(cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
    let value = if D == 1 {
        SortedSample::along_axis(cloud, 0).mean_absolute_difference()
    } else {
        (Compiled::of().pair_distances)(cloud)
    };
    finite(NAME, value)
}

/// Σ_ij w_i w_j ‖x_i − x_j‖.
fn pair_distances<const D: usize>(cloud: &Cloud<'_, D>) -> f64 {
    let points = Packed::new(cloud.points());
    symmetric_sum(&distance(cloud, &points), &PackedWeights::new(cloud))
}

/// Σ_ij w_i u_j ‖x_i − y_j‖ for points y_j of weights u_j.
fn cross_distances<const D: usize>(cloud: &Cloud<'_, D>, points: &Packed<D>, weights: &PackedWeights) -> f64 {
    cross_sum(&distance(cloud, points), &PackedWeights::new(cloud), weights)
}

/// Squared energy distance between two clouds, both as they are (V-statistics):
///
/// ED² = 2 Σ_ij w_i u_j |x_i − y_j| − Σ_ij w_i w_j |x_i − x_j| − Σ_ij u_i u_j |y_i − y_j| ≥ 0,
///
/// symmetric, zero only if the two weighted clouds are the same measure; in one dimension 2 ∫ (F − G)² dx, computed in
/// this form by sorting. What rounding takes below 0 is 0. Its unit is that of the points. If `second` is a sample that stands for a distribution, use
/// [`EnergyReference`], which removes the reference's own bias.
///
/// Source: G. J. Székely, M. L. Rizzo, *Energy statistics: A class of statistics based on distances*, J. Stat. Plan.
/// Inference 143, 2013, §2.
///
/// # Errors
/// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
pub fn energy_distance_squared<const D: usize>(
    first: &Cloud<'_, D>,
    second: &Cloud<'_, D>,
) -> Result<f64, MetricError> {
    if D == 1 {
        let (first, second) = (SortedSample::along_axis(first, 0), SortedSample::along_axis(second, 0));
        return finite(NAME, squared_in_one_dimension(&first, &second));
    }
    let cross = (Compiled::of().cross_distances)(first, &Packed::new(second.points()), &PackedWeights::new(second));
    let value = 2.0 * cross - mean_pair_distance(first)? - mean_pair_distance(second)?;
    Ok(finite(NAME, value)?.max(0.0))
}

/// 2 ∫ (F − G)² dx, free of cancellation.
fn squared_in_one_dimension(first: &SortedSample, second: &SortedSample) -> f64 {
    2.0 * first.integrate_with(second, |f, g| (f - g) * (f - g))
}

/// A reference sample y_1…y_N ~ p, weighted or not, prepared once and compared with many clouds:
///
/// ED²(cloud, p) ≈ 2 Σ_ij w_i u_j |x_i − y_j| − Σ_ij w_i w_j |x_i − x_j| − Σ_{i≠j} u_i u_j |y_i − y_j| / (1 − Σ_j u_j²).
///
/// The reference's own term is the U-statistic, unbiased for E|Y − Y'| if the draws are independent; the cloud's is the
/// V-statistic, because the cloud is a measure of its own. M independent particles then have the expectation
/// E|Y − Y'| / M, and a perfect cloud comes out at zero up to the reference's noise, so small values may be negative.
///
/// Source: Székely & Rizzo 2013 as for [`energy_distance_squared`].
#[derive(Clone, Debug)]
pub struct EnergyReference<const D: usize> {
    mean_distance: f64,
    share: f64,
    storage: Storage<D>,
}

/// The reference in the form that its dimension needs.
#[derive(Clone, Debug)]
enum Storage<const D: usize> {
    Line(SortedSample),
    Space { points: Packed<D>, weights: PackedWeights },
}

impl<const D: usize> EnergyReference<D> {
    /// Copies the reference and computes its own term: O(N log N) in one dimension, O(N²) else.
    ///
    /// # Errors
    /// [`MetricError::TooFewPoints`] unless two points have positive weight, [`MetricError::Overflow`] if a squared
    /// distance exceeds the range of `f64`.
    pub fn new(reference: &Cloud<'_, D>) -> Result<Self, MetricError> {
        let share = reference.distinct_pair_share("the mean distance of a reference sample")?;
        let storage = if D == 1 {
            Storage::Line(SortedSample::along_axis(reference, 0))
        } else {
            Storage::Space {
                points: Packed::new(reference.points()),
                weights: PackedWeights::new(reference),
            }
        };
        Ok(Self {
            mean_distance: mean_pair_distance(reference)? / share,
            share,
            storage,
        })
    }

    /// The unbiased estimate of E|Y − Y'|; divided by M it is the expected ED² of M independent draws.
    pub fn mean_distance(&self) -> f64 {
        self.mean_distance
    }

    /// The squared energy distance of a cloud from the reference: O((M + N) log) in one dimension, O(M (M/2 + N)) else.
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
    pub fn squared(&self, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
        let value = match &self.storage {
            Storage::Line(sample) => {
                // V − U = −U (1 − share) turns the V-statistic of the reference into the U-statistic.
                let plain = squared_in_one_dimension(&SortedSample::along_axis(cloud, 0), sample);
                plain - self.mean_distance * (1.0 - self.share)
            }
            Storage::Space { points, weights } => {
                let cross = (Compiled::of().cross_distances)(cloud, points, weights);
                2.0 * cross - mean_pair_distance(cloud)? - self.mean_distance
            }
        };
        finite(NAME, value)
    }
}
