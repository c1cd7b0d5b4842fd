//! The yardstick of a target in its own dimension.

use std::time::Instant;

use parvi_metrics::{Cloud, Directions, GaussianEnergy, ModeMasses, MomentError, SlicedReference, Standardiser};
use parvi_targets::{BoxedTarget, ImportanceSample, Moments, ReferenceOptions, WeightedDraws};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::target_reference::{ReferenceEnergy, independent, quasi_random};
use super::{Coordinates, Errors, IndependentSets, Yardstick, YardstickOptions};
use crate::CommandError;
use crate::output::Particles;
use crate::sampling::Outcome;
use crate::statistics::summarize;

/// A target, the points that stand for it and the coordinates in which particles are compared with them.
pub struct TargetYardstick<const D: usize> {
    target: BoxedTarget<D>,
    moments: Moments<D>,
    /// `None`: the target's own coordinates.
    coordinates: Option<Standardiser<D>>,
    /// The importance sample of a target without exact draws.
    sample: Option<WeightedDraws<D>>,
    energy: ReferenceEnergy<D>,
    sliced: SlicedReference<D>,
    sliced_level: Option<f64>,
}

/// Points that stand for a target in its own coordinates.
struct Representation<const D: usize> {
    points: Vec<[f64; D]>,
    /// `None`: all equal.
    weights: Option<Vec<f64>>,
    moments: Moments<D>,
    sample: Option<WeightedDraws<D>>,
}

impl<const D: usize> TargetYardstick<D> {
    /// Represents the target; O(N²) for the reference's own term.
    pub fn new(target: BoxedTarget<D>, options: &YardstickOptions) -> Result<Self, CommandError> {
        let Representation {
            points,
            weights,
            moments,
            sample,
        } = match options.coordinates {
            Coordinates::Own => own_representation(&target, options)?,
            Coordinates::Scaled | Coordinates::Standardised => standardised_representation(&target, options)?,
        };
        let coordinates = match (options.coordinates, &sample) {
            (Coordinates::Own, None) => None,
            (Coordinates::Own, Some(_)) | (Coordinates::Scaled, _) => Some(Standardiser::per_axis(&moments)?),
            (Coordinates::Standardised, _) => Some(Standardiser::whitening(&moments)?),
        };
        let points = match &coordinates {
            Some(coordinates) => coordinates.points(&points),
            None => points,
        };
        let cloud = Cloud::with_optional_weights(&points, weights.as_deref())?;
        let energy = match (target.name(), options.coordinates) {
            ("gaussian", Coordinates::Own) => {
                ReferenceEnergy::Gaussian(GaussianEnergy::new(moments.mean, &moments.covariance)?)
            }
            ("gaussian", Coordinates::Standardised) => ReferenceEnergy::Gaussian(GaussianEnergy::standard()?),
            _ => ReferenceEnergy::of_points(&cloud)?,
        };
        let sliced = SlicedReference::new(&cloud, Directions::evenly_spread(options.directions)?);
        let mut yardstick = Self {
            target,
            moments,
            coordinates,
            sample,
            energy,
            sliced,
            sliced_level: None,
        };
        if let Some(sets) = options.independent_sets {
            yardstick.sliced_level = Some(yardstick.sliced_level_of(sets, options.seed)?);
        }
        Ok(yardstick)
    }

    fn sliced_level_of(&self, sets: IndependentSets, seed: u64) -> Result<f64, CommandError> {
        let levels: Result<Vec<f64>, CommandError> = (1..=sets.count as u64)
            .map(|set| {
                let draws = self.draws(sets.size, seed.wrapping_add(set));
                let draws = match &self.coordinates {
                    Some(coordinates) => coordinates.points(&draws),
                    None => draws,
                };
                Ok(self.sliced.distance(&Cloud::new(&draws)?)?)
            })
            .collect();
        Ok(summarize(&levels?)?.median)
    }

    /// Exact draws where the target has them, else draws from the importance sample.
    fn draws(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
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

/// As [`Coordinates::Own`] says.
fn own_representation<const D: usize>(
    target: &BoxedTarget<D>,
    options: &YardstickOptions,
) -> Result<Representation<D>, CommandError> {
    if let (Some(transport), Some(moments)) = (target.unit_cube_transport(), target.moments()) {
        return Ok(Representation {
            points: quasi_random(transport, options.points, options.seed)?,
            weights: None,
            moments,
            sample: None,
        });
    }
    let of_sample = ReferenceOptions {
        seed: options.seed,
        ..ReferenceOptions::default()
    };
    let sample = ImportanceSample::new(target.as_ref(), &of_sample)?;
    let moments = sample.moments().moments;
    let sample = sample.into_draws();
    Ok(Representation {
        points: sample.resampled(options.points, options.seed),
        weights: None,
        moments,
        sample: Some(sample),
    })
}

/// Moments of points of equal weight.
fn of_points<const D: usize>(points: &[[f64; D]]) -> Moments<D> {
    let weights = vec![1.0; points.len()];
    let draws = WeightedDraws {
        points: points.to_vec(),
        weights,
    };
    draws.moments()
}

/// As [`Coordinates::Scaled`] and [`Coordinates::Standardised`] say.
fn standardised_representation<const D: usize>(
    target: &BoxedTarget<D>,
    options: &YardstickOptions,
) -> Result<Representation<D>, CommandError> {
    if let Some(transport) = target.unit_cube_transport() {
        let points = quasi_random(transport, options.points, options.seed)?;
        let moments = match (options.coordinates, target.moments()) {
            (Coordinates::Scaled, _) => of_points(&points),
            (_, Some(moments)) => moments,
            (_, None) => Moments {
                mean: *target.frame().centre(),
                covariance: target.frame().covariance(),
            },
        };
        return Ok(Representation {
            points,
            weights: None,
            moments,
            sample: None,
        });
    }
    let of_sample = ReferenceOptions {
        points: options.points,
        seed: options.seed,
        ..ReferenceOptions::default()
    };
    let sample = ImportanceSample::new(target.as_ref(), &of_sample)?.into_draws();
    Ok(Representation {
        points: sample.points.clone(),
        weights: Some(sample.weights.clone()),
        moments: target.moments().unwrap_or_else(|| sample.moments()),
        sample: Some(sample),
    })
}

impl<const D: usize> Yardstick for TargetYardstick<D> {
    fn mean_distance(&self) -> f64 {
        self.energy.mean_distance()
    }

    fn sliced_level(&self) -> Option<f64> {
        self.sliced_level
    }

    fn has_exact_draws(&self) -> bool {
        self.target.exact_draws().is_some()
    }

    fn independent_draws(&self, count: usize, seed: u64) -> Outcome {
        let begin = Instant::now();
        let points = self.draws(count, seed);
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
        let standardised;
        let cloud = match &self.coordinates {
            Some(coordinates) => {
                standardised = coordinates.points(&points);
                Cloud::with_optional_weights(&standardised, particles.weights())?
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
