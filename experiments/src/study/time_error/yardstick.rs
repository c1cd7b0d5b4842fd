//! What particles are measured against.
//!
//! For a Gaussian the energy distance is exact; every other target is represented by reference points: scrambled Sobol
//! points through its map from the unit cube, or points resampled systematically from an importance sample where it has no
//! such map. Such points are no independent draws but stand for the distribution far more closely, so the reference's own
//! term of the energy distance is its V-statistic. Regressions, whose axes have units of their own, are measured in the
//! posterior's standard deviations per axis; all other targets in their own coordinates.

use std::time::Instant;

use parvi_metrics::{Cloud, Directions, GaussianEnergy, ModeMasses, MomentError, SlicedReference, Standardiser};
use parvi_targets::{BoxedTarget, ImportanceSample, Moments, ReferenceOptions, WeightedDraws};

use super::TimeError;
use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::TargetSpecification;
use crate::output::Particles;
use crate::sampling::Outcome;
use crate::study::target_reference::{ReferenceEnergy, independent, quasi_random};

/// Errors of particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Squared energy distance.
    pub energy_distance_squared: f64,
    /// Sliced Wasserstein distance of order 2.
    pub sliced_wasserstein: f64,
    /// Largest error of a mean in standard deviations.
    pub mean: f64,
    /// Largest relative error of a standard deviation.
    pub deviation: f64,
    /// Largest error of a mode's mass, for targets with modes.
    pub mass: Option<f64>,
}

/// A target as a measure of particles, whatever its dimension.
pub trait Yardstick: Send {
    /// E‖Y − Y'‖ of the target: divided by M, the expected squared energy distance of M independent draws.
    fn mean_distance(&self) -> f64;

    /// Whether the target has exact draws.
    fn has_exact_draws(&self) -> bool;

    /// Independent draws from the importance sample of a target without exact draws.
    fn resample(&self, particles: usize, seed: u64) -> Result<Outcome, CommandError>;

    /// The errors of particles.
    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError>;
}

/// Prepares the reference of a target.
pub fn build(target: &TargetSpecification, study: &TimeError) -> Result<Box<dyn Yardstick>, CommandError> {
    with_target(target, Build { study })
}

struct Build<'a> {
    study: &'a TimeError,
}

impl TargetTask for Build<'_> {
    type Output = Box<dyn Yardstick>;

    fn run<const D: usize>(self, target: BoxedTarget<D>) -> Result<Self::Output, CommandError> {
        Ok(Box::new(TargetYardstick::<D>::new(target, self.study)?))
    }
}

struct TargetYardstick<const D: usize> {
    target: BoxedTarget<D>,
    moments: Moments<D>,
    /// Coordinates in which distances are measured; `None`: the target's own.
    coordinates: Option<Standardiser<D>>,
    /// The importance sample of a target without exact draws.
    sample: Option<WeightedDraws<D>>,
    energy: ReferenceEnergy<D>,
    sliced: SlicedReference<D>,
}

impl<const D: usize> TargetYardstick<D> {
    fn new(target: BoxedTarget<D>, study: &TimeError) -> Result<Self, CommandError> {
        let options = ReferenceOptions {
            seed: study.reference_seed,
            ..ReferenceOptions::default()
        };
        let count = study.reference_points.get();
        let (points, moments, sample) = match (target.unit_cube_transport(), target.moments()) {
            (Some(transport), Some(moments)) => (quasi_random(transport, count, study.reference_seed)?, moments, None),
            _ => {
                let sample = ImportanceSample::new(target.as_ref(), &options)?;
                let moments = sample.moments().moments;
                let sample = sample.into_draws();
                (sample.resampled(count, study.reference_seed), moments, Some(sample))
            }
        };
        let coordinates = sample.as_ref().map(|_| Standardiser::per_axis(&moments)).transpose()?;
        let points = match &coordinates {
            Some(coordinates) => coordinates.points(&points),
            None => points,
        };
        let cloud = Cloud::new(&points)?;
        let energy = if target.name() == "gaussian" {
            ReferenceEnergy::Gaussian(GaussianEnergy::new(moments.mean, &moments.covariance)?)
        } else {
            ReferenceEnergy::of_points(&cloud)?
        };
        let sliced = SlicedReference::new(&cloud, Directions::evenly_spread(study.directions.get())?);
        Ok(Self {
            target,
            moments,
            coordinates,
            sample,
            energy,
            sliced,
        })
    }
}

impl<const D: usize> Yardstick for TargetYardstick<D> {
    fn mean_distance(&self) -> f64 {
        self.energy.mean_distance()
    }

    fn has_exact_draws(&self) -> bool {
        self.target.exact_draws().is_some()
    }

    fn resample(&self, particles: usize, seed: u64) -> Result<Outcome, CommandError> {
        let begin = Instant::now();
        let points = self
            .sample
            .as_ref()
            .map_or(Vec::new(), |sample| independent(sample, particles, seed));
        Ok(Outcome::of_draws(
            Particles::new(&points, None),
            begin.elapsed().as_secs_f64(),
        ))
    }

    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError> {
        let points = particles.points::<D>().unwrap_or_default();
        let own = Cloud::with_optional_weights(&points, particles.weights())?;
        let moments = MomentError::new(&own, &self.moments)?;
        let mass = match self.target.modes() {
            [] => None,
            modes => Some(ModeMasses::new(&own, modes)?.largest_error),
        };
        let scaled;
        let cloud = match &self.coordinates {
            Some(coordinates) => {
                scaled = coordinates.points(&points);
                Cloud::with_optional_weights(&scaled, particles.weights())?
            }
            None => own,
        };
        Ok(Errors {
            energy_distance_squared: self.energy.squared(&cloud)?,
            sliced_wasserstein: self.sliced.distance(&cloud)?,
            mean: moments.largest_mean,
            deviation: moments.largest_standard_deviation,
            mass,
        })
    }
}
