//! The work of most studies: a method on a target, measured or not.

use std::time::Instant;

use parvi::{Method, Run};

use super::attempt::{Attempt, Failure, Status, attempt};
use super::definition::Case;
use super::row::Row;
use super::yardstick::{Errors, Yardstick};
use crate::options::{MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};
use crate::{CommandError, options::OptionError};

/// A method on a target.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// The target.
    pub target: TargetSpecification,
    /// The method.
    pub method: Method,
    /// Number of particles, seed and start.
    pub run: Run,
}

impl Sampled {
    /// A method with its own options, and this number of steps where one is given and it takes steps.
    ///
    /// # Errors
    /// Options that do not fit.
    pub fn new(
        target: &TargetSpecification,
        method: &MethodSpecification,
        steps: Option<usize>,
        (particles, seed): (usize, u64),
    ) -> Result<Self, OptionError> {
        Ok(Self {
            target: target.clone(),
            method: method.method(steps)?,
            run: method.run(particles, seed),
        })
    }

    /// A case of it, whose row says what is run.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn case(self, id: String, method: &str) -> Result<Case<Self>, CommandError> {
        let (target, dim) = (self.target.label(), self.target.dimension()?);
        let (particles, seed) = (self.run.particles, self.run.seed);
        let case = Case::new(id, self).with("target", target).with("dim", dim);
        let case = case.with("method", method).with("particles", particles);
        Ok(case.with("seed", seed))
    }

    /// Samples.
    ///
    /// # Errors
    /// What [`attempt`] does not take for a result.
    pub fn sample(&self, observer: &mut CaseObserver) -> Result<Attempt<Outcome>, CommandError> {
        attempt(sampling::sample(&self.target, &self.method, &self.run, observer))
    }

    /// Samples, or draws from the importance sample of a target without exact draws.
    ///
    /// # Errors
    /// As for [`sample`](Self::sample).
    pub fn sample_or_draw(
        &self,
        yardstick: &dyn Yardstick,
        observer: &mut CaseObserver,
    ) -> Result<Attempt<Outcome>, CommandError> {
        if self.draws_from(yardstick) {
            return Ok(Ok(yardstick.independent_draws(self.run.particles, self.run.seed)));
        }
        self.sample(observer)
    }

    /// Whether its independent draws come from an importance sample.
    pub fn draws_from(&self, yardstick: &dyn Yardstick) -> bool {
        self.method == Method::Iid && !yardstick.has_exact_draws()
    }

    /// Samples and measures, and notes what comes of it.
    ///
    /// # Errors
    /// As for [`sample`](Self::sample), and metrics that cannot be had.
    pub fn run(
        &self,
        row: &mut Row,
        yardstick: &dyn Yardstick,
        observer: &mut CaseObserver,
    ) -> Result<(), CommandError> {
        row.set("energy_level", yardstick.mean_distance() / self.run.particles as f64);
        if let Some(outcome) = row.note(self.sample_or_draw(yardstick, observer)?) {
            row.measured(measured(yardstick, &outcome)?);
        }
        Ok(())
    }
}

/// The errors of particles; such as are so far out that a distance overflows have diverged.
///
/// # Errors
/// Metrics that cannot be had.
pub fn measured(yardstick: &dyn Yardstick, outcome: &Outcome) -> Result<Attempt<Errors>, CommandError> {
    unless_far(yardstick.measure(&outcome.particles))
}

/// A metric that overflows says that the particles have diverged.
///
/// # Errors
/// All others.
pub fn unless_far<T>(measured: Result<T, CommandError>) -> Result<Attempt<T>, CommandError> {
    match measured {
        Ok(value) => Ok(Ok(value)),
        Err(CommandError::Metric(error)) => Ok(Err(Failure::new(Status::Diverged, error))),
        Err(error) => Err(error),
    }
}

/// Seconds that some work took, and what it gave.
pub fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let begin = Instant::now();
    let result = work();
    (begin.elapsed().as_secs_f64(), result)
}
