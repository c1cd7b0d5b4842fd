//! The search for the least number – steps of particles, or draws of a chain – with which a contestant is as good as is asked.

use parvi::SampleError;

use super::contestant::Contestant;
use super::prelude::*;

/// The size of runs with the method's own number of steps or draws.
pub const OWN: usize = 0;
/// No more independent draws than this are made.
const MOST_INDEPENDENT: usize = 10_000_000;

/// What is searched, and when it is given up.
#[derive(Clone, Debug)]
pub struct Search {
    /// Sizes to try, growing.
    sizes: Vec<usize>,
    /// How the search ends where none of them does.
    beyond: Status,
    /// The squared energy distance that the median of the runs of a size has to reach.
    goal: f64,
    /// Seconds; a size whose runs take longer is the last.
    budget: Option<f64>,
    /// A size whose predicted time exceeds the budget by more than this factor is lowered to one that fits.
    tolerance: f64,
}

impl Search {
    /// Without a prediction.
    pub fn of(sizes: Vec<usize>, beyond: Status, goal: f64, budget: Option<f64>) -> Self {
        Self {
            sizes,
            beyond,
            goal,
            budget,
            tolerance: f64::INFINITY,
        }
    }

    /// The same with sizes lowered to what fits into the budget, where their predicted time exceeds it by more than a factor.
    pub fn lowered(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// What comes after the latest runs, which have this size: the next one, or as much as fits into the budget where that would not; an ending.
    fn next(&self, size: usize, latest: &Rows<'_>) -> Result<usize, Status> {
        if median_energy(latest) <= self.goal {
            return Err(Status::Reached);
        }
        let larger = self.sizes.iter().copied().find(|&larger| larger > size);
        let larger = larger.ok_or(self.beyond);
        let (Some(budget), Some(seconds)) = (self.budget, latest.median(SECONDS)) else {
            return larger;
        };
        if seconds >= budget {
            return Err(Status::OutOfTime);
        }
        let (larger, each) = (larger?, seconds / size as f64);
        if each * larger as f64 <= self.tolerance * budget {
            return Ok(larger);
        }
        // Rounded up, so that the run takes the budget rather than a little less.
        let fitting = ((budget / each).ceil() as usize).min(larger);
        Some(fitting).filter(|&fitting| fitting > size).ok_or(Status::OutOfTime)
    }
}

/// What a search came to: how it ended, the size of the last runs, and the largest one that missed the error before it was reached.
pub type Found = (Status, usize, Option<usize>);

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
        let is_enough = needed <= size;
        Ok((if is_enough { Status::Reached } else { search.beyond }, size, None))
    }

    /// Makes the runs of a size that are missing.
    fn make(&mut self, size: usize) -> Result<(), CommandError> {
        let known = of_size(&self.trials, self.columns, size);
        let missing = self.seeds.iter().filter(|seed| known.with("seed", **seed).is_empty());
        missing
            .copied()
            .collect::<Vec<u64>>()
            .into_iter()
            .try_for_each(|seed| self.add(size, seed))
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

/// The median of the squared energy distance, the larger of the two in the middle; a run that diverged is infinitely far.
fn median_energy(runs: &Rows<'_>) -> f64 {
    let energy = |trial: &Row| trial.number(ENERGY).unwrap_or(f64::INFINITY);
    let mut energies: Vec<f64> = runs.iter().map(energy).collect();
    energies.sort_by(f64::total_cmp);
    energies.get(energies.len() / 2).copied().unwrap_or(f64::INFINITY)
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

/// Sizes that double: `{ from = 1000, to = 128000 }`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Doubled {
    /// The first.
    from: Bounded<2, 100_000_000>,
    /// None is larger.
    to: Bounded<2, 100_000_000>,
}

impl Doubled {
    /// The sizes.
    pub fn sizes(self) -> Vec<usize> {
        let larger = |size: &usize| size.checked_mul(2).filter(|size| *size <= self.to.get());
        std::iter::successors(Some(self.from.get()), larger).collect()
    }

    /// Refuses a range without sizes; `field` is its place in the configuration.
    ///
    /// # Errors
    /// Such a range.
    pub fn check(self, field: &str) -> Result<(), CommandError> {
        let Self { from, to } = self;
        holds(from <= to, &format!("{field}.to"), || {
            format!("{to} is below `from` = {from}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: &str = "size wall_seconds";

    fn trial(size: usize, wall_seconds: f64, energy: Option<f64>) -> Row {
        let trial = Row::default().with("size", size).with(SECONDS, wall_seconds);
        trial.with(ENERGY, energy)
    }

    fn search(sizes: &[usize], budget: Option<f64>, tolerance: f64) -> Search {
        Search::of(sizes.to_vec(), Status::OutOfSizes, 1.0, budget).lowered(tolerance)
    }

    fn after(search: &Search, size: usize, seconds: f64, energy: Option<f64>) -> Result<usize, Status> {
        let latest = [trial(size, seconds, energy)];
        search.next(size, &of_size(&latest, COLUMNS, size))
    }

    #[test]
    fn sizes_grow_until_the_error_is_reached() {
        let patient = search(&[1, 2, 4, 8], None, 1.2);
        assert_eq!(after(&patient, 1, 9.0, Some(3.0)), Ok(2));
        assert_eq!(after(&patient, 2, 9.0, Some(1.0)), Err(Status::Reached));
        assert_eq!(after(&patient, 8, 9.0, None), Err(Status::OutOfSizes));
        let [from, to] = [10, 45].map(|size| Bounded::new(size).unwrap());
        let doubled = search(&Doubled { from, to }.sizes(), Some(9.0), f64::INFINITY);
        assert_eq!(after(&doubled, 10, 1.0, Some(1.1)), Ok(20));
        assert_eq!(after(&doubled, 20, 10.0, Some(1.0)), Err(Status::Reached));
        assert_eq!(after(&doubled, 20, 9.0, None), Err(Status::OutOfTime));
        assert_eq!(after(&doubled, 40, 1.0, Some(1.1)), Err(Status::OutOfSizes));
    }

    #[test]
    fn a_run_too_long_for_the_budget_is_shortened_to_it() {
        let within = |budget: f64| search(&[1, 2, 4, 8], Some(budget), 1.2);
        assert_eq!(after(&within(7.0), 4, 4.0, Some(3.0)), Ok(8), "within a fifth");
        assert_eq!(after(&within(6.0), 4, 4.0, Some(3.0)), Ok(6));
        assert_eq!(after(&within(4.0), 4, 4.0, Some(3.0)), Err(Status::OutOfTime));
        assert_eq!(after(&within(2.0), 1, 3.0, Some(3.0)), Err(Status::OutOfTime));
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
