//! The runs of a contestant, of one size after the other, and what they say of it.

use parvi::SampleError;

use super::contestant::Contestant;
use super::prelude::*;
use super::search::{Found, Search, median_energy};

/// The size of runs with the method's own number of steps or draws.
pub const OWN: usize = 0;
/// No more independent draws than this are made.
const MOST_INDEPENDENT: usize = 10_000_000;

/// The runs of a contestant.
pub struct Runs<'a> {
    /// What is run.
    contestant: &'a Contestant,
    /// One run of each size per seed.
    seeds: &'a [u64],
    /// Of the target.
    yardstick: &'a dyn Yardstick,
    /// Watches the runs.
    observer: &'a mut Bar,
    /// What is kept of a run, with spaces between: its size in the first column; its seed; evaluations and time, those of a warm-up included; the squared energy
    /// distance, for independent draws its expectation, where it did not diverge.
    columns: &'static str,
    /// All runs so far.
    pub trials: Vec<Row>,
}

impl<'a> Runs<'a> {
    /// None yet.
    pub fn of(
        contestant: &'a Contestant,
        seeds: &'a [u64],
        yardstick: &'a dyn Yardstick,
        observer: &'a mut Bar,
        columns: &'static str,
    ) -> Self {
        Self {
            contestant,
            seeds,
            yardstick,
            observer,
            columns,
            trials: Vec::new(),
        }
    }

    /// The method as it is.
    ///
    /// # Errors
    /// What [`attempt`] takes for a failure, and what ends a study.
    pub fn own(&mut self) -> Result<Found, CommandError> {
        self.make(OWN)?;
        Ok((Status::Reached, OWN, None))
    }

    /// Larger and larger sizes until the error is reached; of independent draws as many as have it in expectation.
    ///
    /// # Errors
    /// As for [`own`](Self::own).
    pub fn reach(&mut self, search: &Search) -> Result<Found, CommandError> {
        if self.contestant.method.name == MethodName::Iid {
            return self.independent(search);
        }
        let (mut size, mut missed) = (search.sizes.first().copied().unwrap_or(OWN), None);
        loop {
            self.make(size)?;
            match search.next(size, &of_size(&self.trials, self.columns, size)) {
                Ok(larger) => (size, missed) = (larger, Some(size)),
                Err(ending) => return Ok((ending, size, missed)),
            }
        }
    }

    /// M draws beside those, for the figure.
    fn independent(&mut self, search: &Search) -> Result<Found, CommandError> {
        let needed = (self.yardstick.mean_distance() / search.goal).ceil() as usize;
        let size = needed.clamp(2, MOST_INDEPENDENT);
        self.make(self.contestant.particles)?;
        self.make(size)?;
        let ending = if needed <= size { Status::Reached } else { search.beyond };
        Ok((ending, size, None))
    }

    /// Makes the runs of a size that are missing.
    fn make(&mut self, size: usize) -> Result<(), CommandError> {
        let seeds = self.seeds;
        for &seed in seeds {
            let known = of_size(&self.trials, self.columns, size);
            if known.with("seed", seed).is_empty() {
                self.add(size, seed)?;
            }
        }
        Ok(())
    }

    /// One run more. One that diverges has no error; one that the target does not allow is an error.
    ///
    /// # Errors
    /// As for [`own`](Self::own).
    pub fn add(&mut self, size: usize, seed: u64) -> Result<(), CommandError> {
        let Contestant { target, method, .. } = self.contestant;
        let (is_own, iterates) = (size == OWN, method.name.iterates());
        let draws = if is_own || iterates {
            self.contestant.particles
        } else {
            size
        };
        let steps = Some(size).filter(|_| iterates && !is_own);
        let mut work = Sampled::new(target, method, steps, (draws, seed))?;
        let start = self.contestant.start.as_ref();
        work.run.start = start.map_or(work.run.start, |law| law.start(work.run.start));
        let is_expected = method.name == MethodName::Iid && !is_own;
        let (seconds, sampled) = timed(|| match is_expected {
            true => work.sample(self.observer),
            false => work.sample_or_draw(self.yardstick, self.observer),
        });
        if let Err(error @ CommandError::Sample(SampleError::Unsupported { .. })) = sampled {
            return Err(error);
        }
        let mut trial = Row::default().with("seed", seed).with(SECONDS, seconds);
        if let Ok(outcome) = attempt(sampled)? {
            trial.take(&outcome);
            match is_expected {
                true => trial.set(ENERGY, self.yardstick.mean_distance() / size as f64),
                false => trial.measured(self.yardstick.measure(&outcome.particles))?,
            }
        }
        self.trials.push(trial.with(size_column(self.columns), size));
        Ok(())
    }

    /// Keeps the runs, and notes in the row of the case what was found.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn close(self, found: Attempt<Found>, row: &mut Row, directory: &StudyDirectory) -> Result<(), CommandError> {
        row_file::write(&self.contestant.file(directory), self.columns, &self.trials)?;
        let (ending, size, missed) = match found {
            Ok(found) => found,
            Err(failure) => {
                row.set("ending", failure.status);
                row.set("reason", failure.reason);
                return Ok(());
            }
        };
        let last = of_size(&self.trials, self.columns, size);
        row.set("ending", ending);
        row.set("runs", self.trials.len());
        row.set(size_column(self.columns), Some(size).filter(|size| *size > OWN));
        row.set("score_evaluations", last.median("score_evaluations"));
        row.set("density_evaluations", last.median("density_evaluations"));
        row.set(ENERGY, Some(median_energy(&last)).filter(|energy| energy.is_finite()));
        last.note_range(SECONDS, row, WALL);
        row.set("missed_size", missed);
        let missed = missed.map(|size| of_size(&self.trials, self.columns, size).median(SECONDS));
        row.set("wall_seconds_missed", missed.flatten());
        Ok(())
    }
}

fn size_column(columns: &'static str) -> &'static str {
    columns.split(' ').next().unwrap_or_default()
}

/// The runs of one size.
fn of_size<'a>(trials: &'a [Row], columns: &'static str, size: usize) -> Rows<'a> {
    trials.iter().collect::<Rows<'_>>().with(size_column(columns), size)
}

/// The last run and those of the same size.
fn last<'a>(trials: &'a [Row], columns: &'static str) -> Rows<'a> {
    let last = trials.last().and_then(|trial| trial.count(size_column(columns)));
    last.map_or(Rows::default(), |size| of_size(trials, columns, size))
}

/// What the last runs of the method that sets a contestant's task came to: squared energy distance and seconds; `None` before them.
///
/// # Errors
/// A file that cannot be read.
pub fn set_by(
    method: &MethodSpecification,
    contestant: &Contestant,
    directory: &StudyDirectory,
    columns: &'static str,
) -> Result<Option<(f64, f64)>, CommandError> {
    let trials = contestant.first(method).trials(directory, columns)?;
    let last = last(&trials, columns);
    Ok(last.median(SECONDS).map(|seconds| (median_energy(&last), seconds)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: &str = "size wall_seconds";

    fn trial(size: usize, wall_seconds: f64, energy: Option<f64>) -> Row {
        let trial = Row::default().with("size", size).with(SECONDS, wall_seconds);
        trial.with(ENERGY, energy)
    }

    #[test]
    fn the_last_runs_are_those_of_the_last_size() {
        let times = [(1, 9.0), (2, 3.0), (2, 1.0), (2, 2.0)];
        let trials = times.map(|(size, time)| trial(size, time, None));
        assert_eq!(last(&trials, COLUMNS).values(SECONDS), [3.0, 1.0, 2.0]);
        assert!(last(&[], COLUMNS).is_empty());
    }

    #[test]
    fn medians_count_diverged_runs_as_infinitely_far() {
        let trials = [
            trial(10, 3.0, Some(0.3)),
            trial(10, 1.0, None),
            trial(10, 2.0, Some(0.1)),
            trial(20, 9.0, Some(0.0)),
        ];
        let median = |trials: &[Row], size: usize| median_energy(&of_size(trials, COLUMNS, size));
        assert_eq!(median(&trials, 10), 0.3);
        assert_eq!(median(&trials[..2], 10), f64::INFINITY);
        assert_eq!(median(&trials, 30), f64::INFINITY);
    }
}
