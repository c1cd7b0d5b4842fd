//! The energy distance from a target.

use crate::{Cloud, EnergyReference, GaussianEnergy, MetricError, effective_sample_size};

/// The energy distance from a target, exact or from reference points.
#[derive(Clone, Debug)]
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
