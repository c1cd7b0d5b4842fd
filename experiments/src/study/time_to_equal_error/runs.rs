//! The runs of a case: its own, those of a search, or independent draws.

use parvi::SampleError;

use super::TimeToEqualError;
use super::search::{median_energy, next, of_size};
use crate::study::contestant::Contestant;
use crate::study::prelude::*;

/// The size of the method's own runs: its own number of steps.
pub const OWN: usize = 0;
/// No more independent draws than this are made.
const MOST_INDEPENDENT: usize = 10_000_000;

/// The squared energy distance to reach, and the time of the method that set it in seconds.
pub type Goal = (f64, f64);

/// What a search came to: how it ended, the size of the last runs, and the largest one that missed the error before it was reached.
pub type Found = (Status, usize, Option<usize>);

/// The runs of a case.
pub struct Runs<'a> {
    /// The study.
    pub study: &'a TimeToEqualError,
    /// What is run.
    pub entry: &'a Contestant,
    /// Of its target.
    pub yardstick: &'a dyn Yardstick,
    /// Watches the runs.
    pub observer: &'a mut Bar,
    /// All runs so far.
    pub trials: Vec<Row>,
}

impl Runs<'_> {
    /// The method as it is.
    pub fn own(&mut self) -> Result<Found, CommandError> {
        self.make(OWN)?;
        Ok((Status::Reached, OWN, None))
    }

    /// Doubles the size until the error is reached.
    pub fn reach(&mut self, (goal, seconds): Goal) -> Result<Found, CommandError> {
        let sizes = match self.entry.method.name {
            MethodName::Iid => return self.independent(goal),
            name if name.iterates() => self.study.steps,
            _ => self.study.draws,
        };
        let budget = self.study.largest_ratio * seconds;
        let (mut size, mut missed) = (sizes.from.get(), None);
        loop {
            self.make(size)?;
            match next(sizes, size, &of_size(&self.trials, size), goal, budget) {
                Ok(larger) => (size, missed) = (larger, Some(size)),
                Err(ending) => return Ok((ending, size, missed)),
            }
        }
    }

    /// As many independent draws as have the error in expectation; M of them beside that, for the figure.
    fn independent(&mut self, goal: f64) -> Result<Found, CommandError> {
        let needed = (self.yardstick.mean_distance() / goal).ceil() as usize;
        let size = needed.clamp(2, MOST_INDEPENDENT);
        self.make(self.entry.particles)?;
        self.make(size)?;
        let ending = if needed > size {
            Status::OutOfSizes
        } else {
            Status::Reached
        };
        Ok((ending, size, None))
    }

    /// Notes what was found in the row of the case.
    pub fn note(&self, (ending, size, missed): Found, row: &mut Row) {
        let last = of_size(&self.trials, size);
        let energy = Some(median_energy(&last)).filter(|energy| energy.is_finite());
        row.set("ending", ending);
        row.set("size", Some(size).filter(|size| *size > OWN));
        row.set("score_evaluations", last.median("score_evaluations"));
        row.set("density_evaluations", last.median("density_evaluations"));
        row.set(ENERGY, energy);
        last.note_range(SECONDS, row, WALL);
        row.set("missed_size", missed);
        let seconds = missed.map(|size| of_size(&self.trials, size).median(SECONDS));
        row.set("wall_seconds_missed", seconds.flatten());
    }

    /// Makes the runs of a size that are missing.
    fn make(&mut self, size: usize) -> Result<(), CommandError> {
        for &seed in &self.study.seeds {
            if of_size(&self.trials, size).with("seed", seed).is_empty() {
                let trial = self.one(size, seed)?;
                self.trials.push(trial);
            }
        }
        Ok(())
    }

    /// One run; one that diverges is a trial without an error, and one that the target does not allow is an error.
    fn one(&mut self, size: usize, seed: u64) -> Result<Row, CommandError> {
        let Contestant { target, method, .. } = self.entry;
        let (is_own, iterates) = (size == OWN, method.name.iterates());
        let draws = if is_own || iterates { self.entry.particles } else { size };
        let steps = Some(size).filter(|_| iterates && !is_own);
        let work = Sampled::new(target, method, steps, (draws, seed))?;
        let is_expected = method.name == MethodName::Iid && !is_own;
        let (seconds, sampled) = timed(|| match is_expected {
            true => work.sample(self.observer),
            false => work.sample_or_draw(self.yardstick, self.observer),
        });
        if let Err(error @ CommandError::Sample(SampleError::Unsupported { .. })) = sampled {
            return Err(error);
        }
        let mut trial = Row::default()
            .with("size", size)
            .with("seed", seed)
            .with(SECONDS, seconds);
        if let Ok(outcome) = attempt(sampled)? {
            trial.take(&outcome);
            match is_expected {
                true => trial.set(ENERGY, self.yardstick.mean_distance() / size as f64),
                false => trial.measured(self.yardstick.measure(&outcome.particles))?,
            }
        }
        Ok(trial)
    }
}
