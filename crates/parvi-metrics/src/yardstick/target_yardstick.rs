//! The yardstick of a target in its own dimension.

use parvi_targets::{BoxedTarget, Moments, WeightedDraws};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::reference_energy::ReferenceEnergy;
use super::representation::{Representation, independent, own_representation, standardised_representation};
use super::{Coordinates, Errors, ReferenceError, YardstickError, YardstickOptions};
use crate::{Cloud, Directions, GaussianEnergy, MetricError, ModeMasses, MomentError, SlicedReference, Standardiser};

/// A target, the points that stand for it and the coordinates in which particles are compared with them.
pub struct TargetYardstick<const D: usize> {
    target: BoxedTarget<D>,
    moments: Moments<D>,
    /// `None`: the target's own coordinates.
    coordinates: Option<Standardiser<D>>,
    /// The importance sample of a target without exact draws.
    sample: Option<WeightedDraws<D>>,
    error: Option<ReferenceError>,
    energy: ReferenceEnergy<D>,
    sliced: SlicedReference<D>,
}

impl<const D: usize> TargetYardstick<D> {
    /// Represents the target; O(N²) for the reference's own term.
    ///
    /// # Errors
    /// [`YardstickError`]: no points that stand for it, too few, or such as have no finite distances.
    pub fn new(target: BoxedTarget<D>, options: &YardstickOptions) -> Result<Self, YardstickError> {
        (Compiled::of().of_target)(target, options)
    }

    /// [`new`](Self::new), generated where it is called.
    fn of_target(target: BoxedTarget<D>, options: &YardstickOptions) -> Result<Self, YardstickError> {
        let Representation {
            points,
            weights,
            moments,
            sample,
            error,
        } = match options.coordinates {
            Coordinates::Own => own_representation(&target, options)?,
            Coordinates::Scaled | Coordinates::Standardised => standardised_representation(&target, options)?,
        };
        if let Some(error) = error {
            error.suffices_for(0)?;
        }
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
        Ok(Self {
            target,
            moments,
            coordinates,
            sample,
            error,
            energy,
            sliced,
        })
    }

    /// E‖Y − Y'‖ of the target: divided by M, the expected squared energy distance of M independent draws.
    pub fn mean_distance(&self) -> f64 {
        self.energy.mean_distance()
    }

    /// How well the sample is known that stands for the target; `None` where its own map or moments do.
    pub fn reference_error(&self) -> Option<ReferenceError> {
        self.error
    }

    /// Whether the target has exact draws.
    pub fn has_exact_draws(&self) -> bool {
        self.target.exact_draws().is_some()
    }

    /// The sliced Wasserstein distances of sets of independent draws of a size, for what is to be expected of that distance.
    ///
    /// # Errors
    /// [`MetricError`]: a distance that overflows.
    pub fn sliced_of_draws(&self, sets: usize, size: usize, seed: u64) -> Result<Vec<f64>, MetricError> {
        let of_set = |set: u64| {
            let draws = self.draws(size, seed.wrapping_add(set));
            let draws = match &self.coordinates {
                Some(coordinates) => coordinates.points(&draws),
                None => draws,
            };
            self.sliced.distance(&Cloud::new(&draws)?)
        };
        (1..=sets as u64).map(of_set).collect()
    }

    /// Independent draws: exact ones where the target has them, else draws from the importance sample.
    pub fn draws(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
        (Compiled::of().draws)(self, count, seed)
    }

    /// [`draws`](Self::draws), generated where it is called.
    fn drawn(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
        match (self.target.exact_draws(), &self.sample) {
            (Some(exact), _) => {
                let mut generator = ChaCha8Rng::seed_from_u64(seed);
                (0..count).map(|_| exact.draw(&mut generator)).collect()
            }
            (None, Some(sample)) => independent(sample, count, seed),
            (None, None) => Vec::new(),
        }
    }

    /// The errors of particles.
    ///
    /// # Errors
    /// [`MetricError`]: particles that are not finite, or distances that overflow.
    pub fn measure(&self, points: &[[f64; D]], weights: Option<&[f64]>) -> Result<Errors, MetricError> {
        (Compiled::of().errors)(self, points, weights)
    }

    /// [`measure`](Self::measure), generated where it is called.
    fn errors_of(&self, points: &[[f64; D]], weights: Option<&[f64]>) -> Result<Errors, MetricError> {
        let own = Cloud::with_optional_weights(points, weights)?;
        let moments = MomentError::new(&own, &self.moments)?;
        let mass = match self.target.modes() {
            [] => None,
            modes => Some(ModeMasses::new(&own, modes)?.largest_error),
        };
        let standardised;
        let cloud = match &self.coordinates {
            Some(coordinates) => {
                standardised = coordinates.points(points);
                Cloud::with_optional_weights(&standardised, weights)?
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

/// [`TargetYardstick::measure`].
type ErrorsOf<const D: usize> = fn(&TargetYardstick<D>, &[[f64; D]], Option<&[f64]>) -> Result<Errors, MetricError>;

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    of_target: fn(BoxedTarget<D>, &YardstickOptions) -> Result<TargetYardstick<D>, YardstickError>,
    errors: ErrorsOf<D>,
    draws: fn(&TargetYardstick<D>, usize, u64) -> Vec<[f64; D]>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self {
        of_target: TargetYardstick::of_target,
        errors: TargetYardstick::errors_of,
        draws: TargetYardstick::drawn,
    };
}

mpm_parallel::compiled_ahead!(Compiled);
