//! The runs of a case: its own, those of a search, or independent draws.

use super::search::{Ending, Medians, Next, Trial, next};
use super::{Case, TimeToEqualError};
use crate::CommandError;
use crate::options::MethodName;
use crate::progress::CaseObserver;
use crate::sampling;
use crate::study::attempt::{Attempt, Status, attempt};
use crate::study::yardstick::{Yardstick, measured_run};

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
    pub ending: Ending,
    /// The last runs.
    pub last: Medians,
    /// The runs of the largest size that missed the error before it was reached.
    pub missed: Option<Medians>,
}

/// The runs of a case.
pub struct Runs<'a> {
    /// The study.
    pub study: &'a TimeToEqualError,
    /// The case.
    pub case: &'a Case,
    /// Of the case's target.
    pub yardstick: &'a dyn Yardstick,
    /// Watches the runs.
    pub observer: &'a mut CaseObserver,
    /// All runs so far.
    pub trials: Vec<Trial>,
}

impl Runs<'_> {
    /// The method as it is.
    pub fn own(&mut self) -> Result<Attempt<Found>, CommandError> {
        Ok(self.of_size(OWN)?.map(|last| Found {
            ending: Ending::Reached,
            last,
            missed: None,
        }))
    }

    /// Doubles the size until the error is reached.
    pub fn search(&mut self, goal: Goal) -> Result<Attempt<Found>, CommandError> {
        let sizes = match self.case.method.name.iterates() {
            true => self.study.steps.doubling(),
            false => self.study.draws.doubling(),
        };
        let budget = self.study.largest_ratio * goal.seconds;
        let (mut size, mut missed) = (sizes.first, None);
        loop {
            let last = match self.of_size(size)? {
                Attempt::Finished(medians) => medians,
                Attempt::Failed(status, reason) => return Ok(Attempt::Failed(status, reason)),
            };
            match next(sizes, &last, goal.energy_distance_squared, budget) {
                Next::Run(larger) => (size, missed) = (larger, Some(last)),
                Next::End(ending) => return Ok(Attempt::Finished(Found { ending, last, missed })),
            }
        }
    }

    /// As many independent draws as have the error in expectation; M of them beside that, for the figure.
    pub fn independent(&mut self, goal: Goal) -> Result<Attempt<Found>, CommandError> {
        let needed = (self.yardstick.mean_distance() / goal.energy_distance_squared).ceil() as usize;
        let ending = match needed <= MOST_INDEPENDENT {
            true => Ending::Reached,
            false => Ending::OutOfSizes,
        };
        if let Attempt::Failed(status, reason) = self.of_size(self.case.particles)? {
            return Ok(Attempt::Failed(status, reason));
        }
        let last = self.of_size(needed.clamp(2, MOST_INDEPENDENT))?;
        Ok(last.map(|last| Found {
            ending,
            last,
            missed: None,
        }))
    }

    /// The medians of a size; the runs that are missing are made.
    fn of_size(&mut self, size: usize) -> Result<Attempt<Medians>, CommandError> {
        for &seed in &self.study.seeds {
            let is_known = |trial: &Trial| trial.size == size && trial.seed == seed;
            if self.trials.iter().any(is_known) {
                continue;
            }
            match self.one(size, seed)? {
                Attempt::Finished(trial) => self.trials.push(trial),
                Attempt::Failed(status, reason) => return Ok(Attempt::Failed(status, reason)),
            }
        }
        Ok(Attempt::Finished(Medians::of(&self.trials, size)?))
    }

    /// One run; one that diverges is a trial without an error.
    fn one(&mut self, size: usize, seed: u64) -> Result<Attempt<Trial>, CommandError> {
        let Case {
            target,
            particles,
            method,
            ..
        } = self.case;
        let is_own = size == OWN;
        let has_steps = method.name.iterates() && !is_own;
        let draws = if has_steps || is_own { *particles } else { size };
        let run = method.run(draws, seed);
        let begin = std::time::Instant::now();
        let method_of_run = method.method(has_steps.then_some(size))?;
        let ran = if method.name == MethodName::Iid && !is_own {
            let expected = self.yardstick.mean_distance() / size as f64;
            let outcome = attempt(sampling::sample(target, &method_of_run, &run, self.observer))?;
            outcome.map(|outcome| (outcome, Some(expected)))
        } else {
            let finished = measured_run(target, &method_of_run, &run, self.yardstick, self.observer)?;
            finished.map(|finished| {
                let errors = finished.errors.finished();
                (finished.outcome, errors.map(|errors| errors.energy_distance_squared))
            })
        };
        Ok(match ran {
            Attempt::Finished((outcome, energy_distance_squared)) => Attempt::Finished(Trial {
                size,
                seed,
                score_evaluations: Some(outcome.score_evaluations),
                density_evaluations: Some(outcome.density_evaluations),
                wall_seconds: outcome.wall_seconds,
                energy_distance_squared,
            }),
            Attempt::Failed(Status::Unsupported, reason) => Attempt::Failed(Status::Unsupported, reason),
            Attempt::Failed(..) => Attempt::Finished(Trial {
                size,
                seed,
                score_evaluations: None,
                density_evaluations: None,
                wall_seconds: begin.elapsed().as_secs_f64(),
                energy_distance_squared: None,
            }),
        })
    }
}
