//! What particles are measured against, in coordinates in which the target has mean zero and unit covariance.
//!
//! For a Gaussian the energy distance is exact. Every other target is represented by N reference points. The error that the
//! reference brings into ED² = 2E‖x − Y‖ − E‖x − x'‖ − E‖Y − Y'‖ has two parts. One is the mean over the reference of
//! g(y) = 2E‖x − y‖ − 2E‖Y − y‖, which for independent reference points would be of the order (M N)^{−1/2}, several percent of the
//! level E‖Y − Y'‖/M of M independent draws at N = 100 M. The other is ED²(reference, target), for independent points
//! E‖Y − Y'‖/N. Quasi-random points make both far smaller: scrambled Sobol points through the target's map from the unit cube, or
//! where it has none the weighted Sobol points of an importance sample, without resampling. Their own term is the
//! V-statistic, O(N²) once per target.

use std::time::Instant;

use parvi_metrics::{Cloud, Directions, GaussianEnergy, ModeMasses, MomentError, SlicedReference, Standardiser};
use parvi_targets::{BoxedTarget, ImportanceSample, Moments, ReferenceOptions, WeightedDraws};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::Catalogue;
use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::TargetSpecification;
use crate::output::Particles;
use crate::sampling::Outcome;
use crate::statistics::summarize;
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

    /// The median sliced Wasserstein distance of M independent draws.
    fn sliced_level(&self) -> f64;

    /// Whether the target has exact draws.
    fn has_exact_draws(&self) -> bool;

    /// Independent draws from the importance sample of a target without exact draws.
    fn resample(&self, particles: usize, seed: u64) -> Outcome;

    /// The errors of particles.
    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError>;
}

/// Prepares the reference of a target.
pub fn build(target: &TargetSpecification, study: &Catalogue) -> Result<Box<dyn Yardstick>, CommandError> {
    with_target(target, Build { study })
}

struct Build<'a> {
    study: &'a Catalogue,
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
    coordinates: Standardiser<D>,
    /// The importance sample of a target without exact draws.
    sample: Option<WeightedDraws<D>>,
    energy: ReferenceEnergy<D>,
    sliced: SlicedReference<D>,
    sliced_level: f64,
}

impl<const D: usize> TargetYardstick<D> {
    fn new(target: BoxedTarget<D>, study: &Catalogue) -> Result<Self, CommandError> {
        let (count, seed) = (study.reference_points.get(), study.reference_seed);
        let (points, sample) = match target.unit_cube_transport() {
            Some(transport) => (quasi_random(transport, count, seed)?, None),
            None => {
                let options = ReferenceOptions {
                    points: count,
                    seed,
                    ..ReferenceOptions::default()
                };
                let sample = ImportanceSample::new(target.as_ref(), &options)?.into_draws();
                (sample.points.clone(), Some(sample))
            }
        };
        let moments = match (target.moments(), &sample) {
            (Some(moments), _) => moments,
            (None, Some(sample)) => sample.moments(),
            (None, None) => Moments {
                mean: *target.frame().centre(),
                covariance: target.frame().covariance(),
            },
        };
        let coordinates = Standardiser::whitening(&moments)?;
        let points = coordinates.points(&points);
        let weights = sample.as_ref().map(|sample| sample.weights.as_slice());
        let cloud = Cloud::with_optional_weights(&points, weights)?;
        let energy = match target.name() {
            "gaussian" => ReferenceEnergy::Gaussian(GaussianEnergy::standard()?),
            _ => ReferenceEnergy::of_points(&cloud)?,
        };
        let sliced = SlicedReference::new(&cloud, Directions::evenly_spread(study.directions.get())?);
        let mut yardstick = Self {
            target,
            moments,
            coordinates,
            sample,
            energy,
            sliced,
            sliced_level: f64::NAN,
        };
        let levels: Result<Vec<f64>, CommandError> = (1..=study.draws.get() as u64)
            .map(|set| {
                let draws = yardstick.independent(study.particles.get(), seed.wrapping_add(set));
                let draws = yardstick.coordinates.points(&draws);
                Ok(yardstick.sliced.distance(&Cloud::new(&draws)?)?)
            })
            .collect();
        yardstick.sliced_level = summarize(&levels?)?.median;
        Ok(yardstick)
    }

    /// Exact draws where the target has them, else draws from the importance sample.
    fn independent(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
        match (self.target.exact_draws(), &self.sample) {
            (Some(exact), _) => {
                let mut generator = ChaCha8Rng::seed_from_u64(seed);
                (0..count).map(|_| exact.draw(&mut generator)).collect()
            }
            (None, Some(sample)) => independent(sample, count, seed),
            (None, None) => Vec::new(),
        }
    }
}

impl<const D: usize> Yardstick for TargetYardstick<D> {
    fn mean_distance(&self) -> f64 {
        self.energy.mean_distance()
    }

    fn sliced_level(&self) -> f64 {
        self.sliced_level
    }

    fn has_exact_draws(&self) -> bool {
        self.target.exact_draws().is_some()
    }

    fn resample(&self, particles: usize, seed: u64) -> Outcome {
        let begin = Instant::now();
        let points = self.independent(particles, seed);
        Outcome::of_draws(Particles::new(&points, None), begin.elapsed().as_secs_f64())
    }

    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError> {
        let points = particles.points::<D>().unwrap_or_default();
        let own = Cloud::with_optional_weights(&points, particles.weights())?;
        let moments = MomentError::new(&own, &self.moments)?;
        let mass = match self.target.modes() {
            [] => None,
            modes => Some(ModeMasses::new(&own, modes)?.largest_error),
        };
        let standardised = self.coordinates.points(&points);
        let cloud = Cloud::with_optional_weights(&standardised, particles.weights())?;
        Ok(Errors {
            energy_distance_squared: self.energy.squared(&cloud)?,
            sliced_wasserstein: self.sliced.distance(&cloud)?,
            mean: moments.largest_mean,
            deviation: moments.largest_standard_deviation,
            mass,
        })
    }
}
