//! What particles on a target are measured against, for every study that compares methods on the catalogue: the yardsticks of `parvi-metrics`, whatever their dimension.

use std::time::Instant;

pub use parvi_metrics::yardstick::{Errors, YardstickOptions};
use parvi_metrics::yardstick::{TargetYardstick, YardstickError};
use parvi_targets::BoxedTarget;

use crate::CommandError;
use crate::dispatch::on_target;
use crate::options::TargetSpecification;
use crate::output::Particles;
use crate::sampling::Outcome;
use crate::statistics::summarize;

/// Sets of independent draws, whose median sliced Wasserstein distance is the level of that distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndependentSets {
    /// Their number.
    pub count: usize,
    /// Draws in each.
    pub size: usize,
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
        sets: Option<IndependentSets>,
    ) -> Result<&dyn Yardstick, CommandError> {
        let (_, yardstick) = match self.current.take() {
            Some((known, yardstick)) if known == *target => self.current.insert((known, yardstick)),
            _ => {
                let made: Box<dyn Yardstick> = on_target!(target, built, D => boxed::<D>(built, options, sets))?;
                self.current.insert((target.clone(), made))
            }
        };
        Ok(&**yardstick)
    }
}

/// A yardstick with the level of its sliced distance.
struct Levelled<const D: usize> {
    yardstick: TargetYardstick<D>,
    sliced_level: Option<f64>,
}

fn boxed<const D: usize>(
    target: BoxedTarget<D>,
    options: &YardstickOptions,
    sets: Option<IndependentSets>,
) -> Result<Box<dyn Yardstick>, CommandError> {
    let yardstick = TargetYardstick::new(target, options)?;
    let sliced_level = match sets {
        None => None,
        Some(sets) => {
            let levels = yardstick.sliced_of_draws(sets.count, sets.size, options.seed)?;
            Some(summarize(&levels)?.median)
        }
    };
    Ok(Box::new(Levelled {
        yardstick,
        sliced_level,
    }))
}

impl From<YardstickError> for CommandError {
    fn from(error: YardstickError) -> Self {
        match error {
            YardstickError::Target(error) => error.into(),
            YardstickError::Metric(error) => error.into(),
            error => Self::Library(error.into()),
        }
    }
}

impl<const D: usize> Yardstick for Levelled<D> {
    fn mean_distance(&self) -> f64 {
        self.yardstick.mean_distance()
    }

    fn sliced_level(&self) -> Option<f64> {
        self.sliced_level
    }

    fn has_exact_draws(&self) -> bool {
        self.yardstick.has_exact_draws()
    }

    fn independent_draws(&self, count: usize, seed: u64) -> Outcome {
        let begin = Instant::now();
        let points = self.yardstick.draws(count, seed);
        Outcome::of_draws(Particles::new(&points, None), begin.elapsed().as_secs_f64())
    }

    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError> {
        let points = particles.points::<D>().unwrap_or_default();
        Ok(self.yardstick.measure(&points, particles.weights())?)
    }
}
