//! Points that stand for a target, and the energy distance from them.

use parvi_metrics::{Cloud, EnergyReference, GaussianEnergy, MetricError, effective_sample_size};
use parvi_targets::{SobolSequence, UnitCubeTransport, WeightedDraws};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::CommandError;

/// Scrambled Sobol points through the target's map.
pub fn quasi_random<const D: usize>(
    transport: &dyn UnitCubeTransport<D>,
    count: usize,
    seed: u64,
) -> Result<Vec<[f64; D]>, CommandError> {
    let sequence = SobolSequence::scrambled(transport.cube_dimension(), seed)?;
    let count = u32::try_from(count).unwrap_or(u32::MAX);
    Ok((0..count)
        .map(|index| transport.transport(&sequence.point(index)))
        .collect())
}

/// Independent draws from weighted points, by inversion of their cumulative weights.
pub fn independent<const D: usize>(sample: &WeightedDraws<D>, count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut total = 0.0;
    let cumulative: Vec<f64> = sample
        .weights
        .iter()
        .map(|weight| {
            total += weight;
            total
        })
        .collect();
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let last = sample.points.len().saturating_sub(1);
    (0..count)
        .filter_map(|_| {
            let goal = generator.random::<f64>() * total;
            sample
                .points
                .get(cumulative.partition_point(|&sum| sum <= goal).min(last))
                .copied()
        })
        .collect()
}

/// The energy distance from a target, exact or from reference points.
pub enum ReferenceEnergy<const D: usize> {
    /// Exact.
    Gaussian(GaussianEnergy<D>),
    /// From points.
    Points {
        /// The points, with the U-statistic of their own term.
        reference: EnergyReference<D>,
        /// V − U of that term: U pairs distinct points only, V all.
        pairs_with_themselves: f64,
    },
}

impl<const D: usize> ReferenceEnergy<D> {
    /// From quasi-random points, weighted or not. They stand for the distribution far more closely than independent draws
    /// do, so their own term is the V-statistic.
    pub fn of_points(cloud: &Cloud<'_, D>) -> Result<Self, MetricError> {
        let reference = EnergyReference::new(cloud)?;
        let count = match cloud.weights() {
            Some(weights) => effective_sample_size(weights)?,
            None => cloud.len() as f64,
        };
        Ok(Self::Points {
            pairs_with_themselves: -reference.mean_distance() / count,
            reference,
        })
    }

    /// E‖Y − Y'‖ of the target: divided by M, the expected squared energy distance of M independent draws.
    pub fn mean_distance(&self) -> f64 {
        match self {
            Self::Gaussian(energy) => energy.mean_distance(),
            Self::Points {
                reference,
                pairs_with_themselves,
            } => reference.mean_distance() + pairs_with_themselves,
        }
    }

    /// The squared energy distance of a cloud.
    pub fn squared(&self, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
        match self {
            Self::Gaussian(energy) => energy.squared(cloud),
            Self::Points {
                reference,
                pairs_with_themselves,
            } => Ok(reference.squared(cloud)? - pairs_with_themselves),
        }
    }
}
