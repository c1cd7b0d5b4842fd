//! What particles on a target are measured against, for every study that compares methods on the catalogue.
//!
//! For a Gaussian the energy distance is exact. Every other target is represented by N reference points. The error that the
//! reference brings into ED² = 2E‖x − Y‖ − E‖x − x'‖ − E‖Y − Y'‖ has two parts. One is the mean over the reference of
//! g(y) = 2E‖x − y‖ − 2E‖Y − y‖, which for independent reference points would be of the order (M N)^{−1/2}, several percent of the
//! level E‖Y − Y'‖/M of M independent draws at N = 100 M. The other is ED²(reference, target), for independent points
//! E‖Y − Y'‖/N. Quasi-random points make both far smaller: scrambled Sobol points through the target's map from the unit cube, or
//! where it has none those of an importance sample. Their own term is the V-statistic, O(N²) once per target.

mod measured_run;
mod target_reference;
mod target_yardstick;

use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::TargetSpecification;
use crate::output::Particles;
use crate::sampling::Outcome;

pub use measured_run::{measured, measured_run};
use target_yardstick::TargetYardstick;

/// How a target is represented and particles are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YardstickOptions {
    /// N, the reference points that stand for the target; a power of two keeps their balance.
    pub points: usize,
    /// Their seed.
    pub seed: u64,
    /// Directions of the sliced Wasserstein distance.
    pub directions: usize,
    /// What distances are measured in.
    pub coordinates: Coordinates,
    /// Sets of independent draws whose median sliced Wasserstein distance is the level of that distance; `None`: it has none.
    pub independent_sets: Option<IndependentSets>,
}

/// The coordinates in which distances are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// The target's own. Only targets without exact moments and a map from the unit cube, the posteriors of regressions, whose axes
    /// have units of their own, are measured in standard deviations per axis, against points resampled systematically from an
    /// importance sample.
    Own,
    /// Standard deviations per axis of the points that stand for the target, as for [`Standardised`](Self::Standardised).
    Scaled,
    /// Those in which the target has mean zero and unit covariance. A target without a map from the unit cube is represented by the
    /// weighted points of an importance sample.
    Standardised,
}

impl YardstickOptions {
    /// So many points of a seed; the sliced distance is not looked at.
    pub fn of_energy(points: usize, seed: u64, coordinates: Coordinates) -> Self {
        Self {
            points,
            seed,
            directions: 1,
            coordinates,
            independent_sets: None,
        }
    }
}

/// Sets of independent draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndependentSets {
    /// Their number.
    pub count: usize,
    /// Draws in each.
    pub size: usize,
}

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

    /// The median sliced Wasserstein distance of the sets of independent draws; `None` without such sets.
    fn sliced_level(&self) -> Option<f64>;

    /// Whether the target has exact draws.
    fn has_exact_draws(&self) -> bool;

    /// Independent draws: exact ones where the target has them, else from its importance sample.
    fn independent_draws(&self, count: usize, seed: u64) -> Outcome;

    /// The errors of particles.
    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError>;
}

/// The yardstick of the target at hand, made once for all cases of the target.
#[derive(Default)]
pub struct CurrentYardstick {
    current: Option<(TargetSpecification, Box<dyn Yardstick>)>,
}

impl CurrentYardstick {
    /// The yardstick of a target; the one at hand if it is the same target's, else a new one.
    pub fn of(
        &mut self,
        target: &TargetSpecification,
        options: &YardstickOptions,
    ) -> Result<&dyn Yardstick, CommandError> {
        let (_, yardstick) = match self.current.take() {
            Some((known, yardstick)) if known == *target => self.current.insert((known, yardstick)),
            _ => self
                .current
                .insert((target.clone(), with_target(target, Build { options })?)),
        };
        Ok(&**yardstick)
    }
}

struct Build<'a> {
    options: &'a YardstickOptions,
}

impl TargetTask for Build<'_> {
    type Output = Box<dyn Yardstick>;

    fn run<const D: usize>(self, target: parvi_targets::BoxedTarget<D>) -> Result<Self::Output, CommandError> {
        Ok(Box::new(TargetYardstick::<D>::new(target, self.options)?))
    }
}
