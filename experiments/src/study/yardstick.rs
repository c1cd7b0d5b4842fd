//! What particles on a target are measured against, for every study that compares methods on the catalogue: the yardsticks of `parvi-metrics`, whatever their dimension.

use std::time::Instant;

use parvi_files::{Outcome, Particles};
pub use parvi_metrics::yardstick::{Coordinates, Errors, ReferenceError, YardstickOptions};
use parvi_metrics::yardstick::{TargetYardstick, YardstickError};
use parvi_options::TargetSpecification;

use super::attempt::Failure;
use super::status::Status;
use crate::CommandError;
use crate::dispatch::on_target;
use crate::plots::results::Row;
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

    /// The median sliced Wasserstein distance of sets of independent draws.
    fn sliced_level(&self, sets: IndependentSets, seed: u64) -> Result<f64, CommandError>;

    /// How well the sample is known that stands for the target, where one does.
    fn reference_error(&self) -> Option<ReferenceError>;

    /// Whether the target has exact draws.
    fn has_exact_draws(&self) -> bool;

    /// Independent draws: exact ones where the target has them, else from its importance sample.
    fn independent_draws(&self, count: usize, seed: u64) -> Outcome;

    /// The errors of particles.
    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError>;
}

/// The yardstick of the target at hand, made once for all cases of the target, and the level of its sliced distance.
#[derive(Default)]
pub struct CurrentYardstick {
    current: Option<(TargetSpecification, Box<dyn Yardstick>, Option<f64>)>,
}

impl CurrentYardstick {
    /// The yardstick of a target; the one at hand if it is the same target's, else a new one. How well the sample is known that stands for the target, where one does, is noted in
    /// the row of the case.
    ///
    /// # Errors
    /// What cannot be built, and a failure where such a sample is not worth the row's `particles`.
    pub fn of(
        &mut self,
        target: &TargetSpecification,
        options: &YardstickOptions,
        row: &mut Row,
    ) -> Result<&dyn Yardstick, CommandError> {
        Ok(self.levelled(target, options, None, row)?.0)
    }

    /// The same with the median sliced Wasserstein distance of sets of independent draws, if there are to be any.
    pub fn levelled(
        &mut self,
        target: &TargetSpecification,
        options: &YardstickOptions,
        sets: Option<IndependentSets>,
        row: &mut Row,
    ) -> Result<(&dyn Yardstick, Option<f64>), CommandError> {
        let (_, yardstick, level) = match self.current.take() {
            Some(current) if current.0 == *target => self.current.insert(current),
            _ => {
                let made = on_target!(target, built, D => {
                    let made = TargetYardstick::<D>::new(built, options);
                    if let Err(YardstickError::ReferenceTooSmall { effective_size, .. }) = &made {
                        row.set("reference_size", *effective_size);
                    }
                    Ok(Box::new(made?) as Box<dyn Yardstick>)
                })?;
                let level = sets.map(|sets| made.sliced_level(sets, options.seed)).transpose()?;
                self.current.insert((target.clone(), made, level))
            }
        };
        if let Some(known) = yardstick.reference_error() {
            row.set("reference_size", known.effective_size);
            row.set("reference_mean_error", known.mean);
            row.set("reference_deviation_error", known.deviation);
            known.suffices_for(row.count("particles").unwrap_or(0))?;
        }
        Ok((&**yardstick, *level))
    }
}

impl From<YardstickError> for CommandError {
    fn from(error: YardstickError) -> Self {
        match error {
            YardstickError::Target(error) => error.into(),
            error @ (YardstickError::ReferenceTooSmall { .. } | YardstickError::Metric(_)) => {
                Failure::new(Status::NoReference, error).into()
            }
            error => Self::Library(error.into()),
        }
    }
}

impl<const D: usize> Yardstick for TargetYardstick<D> {
    fn mean_distance(&self) -> f64 {
        TargetYardstick::mean_distance(self)
    }

    fn sliced_level(&self, sets: IndependentSets, seed: u64) -> Result<f64, CommandError> {
        let levels = self.sliced_of_draws(sets.count, sets.size, seed)?;
        Ok(summarize(&levels)?.median)
    }

    fn reference_error(&self) -> Option<ReferenceError> {
        TargetYardstick::reference_error(self)
    }

    fn has_exact_draws(&self) -> bool {
        TargetYardstick::has_exact_draws(self)
    }

    fn independent_draws(&self, count: usize, seed: u64) -> Outcome {
        let begin = Instant::now();
        let points = self.draws(count, seed);
        Outcome::of_draws(Particles::new(&points, None), begin.elapsed().as_secs_f64())
    }

    fn measure(&self, particles: &Particles) -> Result<Errors, CommandError> {
        let points = particles.points::<D>().unwrap_or_default();
        Ok(TargetYardstick::measure(self, &points, particles.weights())?)
    }
}
