//! The runs of a case: its own, those of a search, or independent draws.

use parvi::SampleError;

use super::search::{Medians, Trial, next};
use super::{Entry, TimeToEqualError};
use crate::study::prelude::*;

/// The size of the method's own runs: its own number of steps.
pub const OWN: usize = 0;
/// No more independent draws than this are made.
const MOST_INDEPENDENT: usize = 10_000_000;

/// The error to reach and the time of the method that set it.
#[derive(Clone, Copy)]
pub struct Goal {
    /// Squared energy distance.
    pub energy_distance_squared: f64,
    /// Time.
    pub seconds: f64,
}

/// What a search came to.
pub struct Found {
    /// How it ended.
    pub ending: Status,
    /// The last runs.
    pub last: Medians,
    /// The runs of the largest size that missed the error before it was reached.
    pub missed: Option<Medians>,
}

impl Found {
    /// Without a size that missed the error.
    fn at_once(ending: Status, last: Medians) -> Self {
        Self {
            ending,
            last,
            missed: None,
        }
    }
}

/// The runs of a case.
pub struct Runs<'a> {
    /// The study.
    pub study: &'a TimeToEqualError,
    /// What is run.
    pub entry: &'a Entry,
    /// Of its target.
    pub yardstick: &'a dyn Yardstick,
    /// Watches the runs.
    pub observer: &'a mut CaseObserver,
    /// All runs so far.
    pub trials: Vec<Trial>,
}

impl Runs<'_> {
    /// The method as it is.
    pub fn own(&mut self) -> Result<Found, CommandError> {
        Ok(Found::at_once(Status::Reached, self.of_size(OWN)?))
    }

    /// Doubles the size until the error is reached.
    pub fn search(&mut self, goal: Goal) -> Result<Found, CommandError> {
        let sizes = match self.entry.method.name.iterates() {
            true => self.study.steps.doubling(),
            false => self.study.draws.doubling(),
        };
        let budget = self.study.largest_ratio * goal.seconds;
        let (mut size, mut missed) = (sizes.first, None);
        loop {
            let last = self.of_size(size)?;
            match next(sizes, &last, goal.energy_distance_squared, budget) {
                Ok(larger) => (size, missed) = (larger, Some(last)),
                Err(ending) => return Ok(Found { ending, last, missed }),
            }
        }
    }

    /// As many independent draws as have the error in expectation; M of them beside that, for the figure.
    pub fn independent(&mut self, goal: Goal) -> Result<Found, CommandError> {
        let needed = (self.yardstick.mean_distance() / goal.energy_distance_squared).ceil() as usize;
        let ending = match needed <= MOST_INDEPENDENT {
            true => Status::Reached,
            false => Status::OutOfSizes,
        };
        self.of_size(self.entry.particles)?;
        let last = self.of_size(needed.clamp(2, MOST_INDEPENDENT))?;
        Ok(Found::at_once(ending, last))
    }

    /// The medians of a size; the runs that are missing are made.
    fn of_size(&mut self, size: usize) -> Result<Medians, CommandError> {
        for &seed in &self.study.seeds {
            let is_known = |trial: &Trial| trial.size == size && trial.seed == seed;
            if !self.trials.iter().any(is_known) {
                let trial = self.one(size, seed)?;
                self.trials.push(trial);
            }
        }
        Medians::of(&self.trials, size)
    }

    /// One run; one that diverges is a trial without an error, and one that the target does not allow is an error.
    fn one(&mut self, size: usize, seed: u64) -> Result<Trial, CommandError> {
        let Entry { target, method, .. } = self.entry;
        let is_own = size == OWN;
        let has_steps = method.name.iterates() && !is_own;
        let draws = if has_steps || is_own {
            self.entry.particles
        } else {
            size
        };
        let work = Sampled::new(target, method, has_steps.then_some(size), (draws, seed))?;
        let is_expected = method.name == MethodName::Iid && !is_own;
        let (seconds, sampled) = timed(|| match is_expected {
            true => work.sample(self.observer),
            false => work.sample_or_draw(self.yardstick, self.observer),
        });
        let outcome = match sampled {
            Err(error @ CommandError::Sample(SampleError::Unsupported { .. })) => return Err(error),
            sampled => attempt(sampled)?.ok(),
        };
        let energy_distance_squared = match &outcome {
            None => None,
            Some(_) if is_expected => Some(self.yardstick.mean_distance() / size as f64),
            Some(outcome) => {
                let errors = attempt(self.yardstick.measure(&outcome.particles))?.ok();
                errors.map(|errors| errors.energy_distance_squared)
            }
        };
        Ok(Trial {
            size,
            seed,
            score_evaluations: outcome.as_ref().map(|outcome| outcome.score_evaluations),
            density_evaluations: outcome.as_ref().map(|outcome| outcome.density_evaluations),
            wall_seconds: outcome.map_or(seconds, |outcome| outcome.wall_seconds),
            energy_distance_squared,
        })
    }
}
