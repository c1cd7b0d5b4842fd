//! The sliced Wasserstein distance: exact transport on the line, averaged over directions.

use crate::error::finite;
use crate::sorted::SortedSample;
use crate::summation::sum;
use crate::wasserstein::transport_cost;
use crate::{Cloud, Directions, MetricError};

/// The sliced Wasserstein distance of order 2 between two weighted clouds,
///
/// SW₂ = ( 1/L Σ_l W₂²(θ_l·x, θ_l·y) )^{1/2},
///
/// with the exact W₂ of every projection; sizes may differ. Its unit is that of the points. O(L (M + N) log), the
/// directions in parallel, independent of the number of threads.
///
/// Source: N. Bonneel, J. Rabin, G. Peyré, H. Pfister, *Sliced and Radon Wasserstein barycenters of measures*, J. Math.
/// Imaging Vis. 51, 2015.
///
/// # Errors
/// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
pub fn sliced_wasserstein<const D: usize>(
    first: &Cloud<'_, D>,
    second: &Cloud<'_, D>,
    directions: &Directions<D>,
) -> Result<f64, MetricError> {
    average(directions, |_, direction| {
        transport_cost(&project(first, direction), &project(second, direction), square)
    })
}

/// A reference sample, projected and sorted once, for the distance to many clouds.
///
/// It holds L (M + N) numbers for N reference points. A finite reference is itself away from its distribution: for a
/// cloud as good as the distribution the value is about that of the reference's own noise.
#[derive(Clone, Debug)]
pub struct SlicedReference<const D: usize> {
    directions: Directions<D>,
    projections: Vec<SortedSample>,
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    /// [`SlicedReference::new`].
    slices: fn(&Cloud<'_, D>, Directions<D>) -> SlicedReference<D>,
    /// [`SlicedReference::distance`].
    distance: fn(&SlicedReference<D>, &Cloud<'_, D>) -> Result<f64, MetricError>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self { slices, distance };
}

mpm_parallel::compiled_ahead!(Compiled);

impl<const D: usize> SlicedReference<D> {
    /// Projects and sorts the reference: O(L N log N).
    pub fn new(reference: &Cloud<'_, D>, directions: Directions<D>) -> Self {
        (Compiled::of().slices)(reference, directions)
    }

    /// The sliced Wasserstein distance of a cloud from the reference, as [`sliced_wasserstein`] gives it.
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
    pub fn distance(&self, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
        (Compiled::of().distance)(self, cloud)
    }
}

/// [`SlicedReference::new`].
fn slices<const D: usize>(reference: &Cloud<'_, D>, directions: Directions<D>) -> SlicedReference<D> {
    let projections = mpm_parallel::map(directions.vectors().iter(), &|direction| project(reference, direction));
    SlicedReference {
        directions,
        projections,
    }
}

/// [`SlicedReference::distance`].
fn distance<const D: usize>(reference: &SlicedReference<D>, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
    average(&reference.directions, |index, direction| {
        transport_cost(&project(cloud, direction), &reference.projections[index], square)
    })
}

fn square(x: f64) -> f64 {
    x * x
}

fn project<const D: usize>(cloud: &Cloud<'_, D>, direction: &[f64; D]) -> SortedSample {
    SortedSample::projected(cloud, |point| mpm_tensor::vector::dot(point, direction))
}

/// The root of the mean of `cost` over the directions, added in order.
fn average<const D: usize>(
    directions: &Directions<D>,
    cost: impl Fn(usize, &[f64; D]) -> f64 + Sync,
) -> Result<f64, MetricError> {
    let numbered = directions.vectors().iter().enumerate();
    let costs = mpm_parallel::map(numbered, &|(index, direction)| cost(index, direction));
    let count = costs.len() as f64;
    Ok(finite("the sliced Wasserstein distance", sum(costs) / count)?.sqrt())
}
