//! Study `time-to-level`: the wall time from one start to the error of independent draws, a method against its rivals.
//!
//! Target N(0, I); the level is E‖Y − Y'‖ / M, the expected squared energy distance of M independent draws. A method is run
//! from the start with T = 1, 2, 3, … steps of the configured list until a run ends at or below the level; its time is that
//! of this one run. A rival gets as its budget a multiple of the method's time: a lower bound is a result.

mod configuration;
mod report;
mod search;

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use configuration::TimeToLevel;
use search::Ending;

use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::gaussian_runs::energy_level;
use super::{results, table_file};
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification};
use crate::progress::CaseObserver;

/// One method in one dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    dim: Dimension,
    particles: usize,
    /// 0 for the method that sets the clock, then its rivals.
    index: usize,
    method: MethodSpecification,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("d{}-m{}-{}", self.dim, self.particles, self.method.label())
    }

    fn cost(&self) -> f64 {
        // The budget of a rival is a multiple of the method's time.
        self.dim.get() as f64 + 1.0
    }
}

impl Case {
    /// The file of its runs.
    fn trials_file(&self, directory: &StudyDirectory) -> PathBuf {
        directory.raw(&format!("d{}-{}-{}.csv", self.dim, self.index, self.method.name))
    }
}

/// What a case gave. Columns that begin with `wall` depend on the machine, and so does where a search ran out of time; the
/// others depend only on the seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    case: String,
    ending: Ending,
    dim: usize,
    particles: usize,
    method: String,
    /// The squared energy distance to reach.
    energy_level: f64,
    /// Runs in all, repeats included.
    runs: usize,
    /// Steps of the last run.
    steps: usize,
    /// Squared energy distance after it.
    energy_distance_squared: Option<f64>,
    /// The median time of the last run and its repeats.
    wall_seconds: f64,
    wall_seconds_least: f64,
    wall_seconds_most: f64,
    /// The time allowed.
    wall_budget_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

/// The times of the method that sets the clock, by dimension, as far as it ran in this process.
#[derive(Default)]
pub struct Clock {
    seconds: Vec<(Dimension, f64)>,
}

impl Study for TimeToLevel {
    type Case = Case;
    type Row = Row;
    type Shared = Clock;

    const KIND: &'static str = "time-to-level";

    fn seeds(&self) -> Vec<u64> {
        vec![self.seed]
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.all_cases()
    }

    fn run(
        &self,
        case: &Case,
        clock: &mut Clock,
        directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let level = energy_level(case.dim, case.particles)?;
        let sets_the_clock = case.index == 0;
        let budget = if sets_the_clock {
            None
        } else {
            Some(self.largest_ratio * self.clock(case.dim, clock, directory)?)
        };
        let (ending, trials) = search::search(self, case, level, budget, observer)?;
        table_file::write(&trials, &case.trials_file(directory))?;
        let [least, median, most] = search::seconds(&trials)?;
        if sets_the_clock {
            clock.seconds.push((case.dim, median));
        }
        let last = trials.last();
        Ok(Row {
            case: definition::Case::id(case),
            ending,
            dim: case.dim.get(),
            particles: case.particles,
            method: case.method.label().to_owned(),
            energy_level: level,
            runs: trials.len(),
            steps: last.map_or(0, |trial| trial.steps),
            energy_distance_squared: last.and_then(|trial| trial.energy_distance_squared),
            wall_seconds: median,
            wall_seconds_least: least,
            wall_seconds_most: most,
            wall_budget_seconds: budget,
        })
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

impl TimeToLevel {
    /// The method's time in a dimension, from this process or from the raw results of an earlier one.
    fn clock(&self, dim: Dimension, clock: &Clock, directory: &StudyDirectory) -> Result<f64, CommandError> {
        if let Some((_, seconds)) = clock.seconds.iter().find(|(known, _)| *known == dim) {
            return Ok(*seconds);
        }
        let first = self
            .all_cases()?
            .into_iter()
            .find(|case| case.dim == dim && case.index == 0);
        let trials = first.map_or(Ok(Vec::new()), |case| table_file::read(&case.trials_file(directory)))?;
        Ok(search::seconds(&trials)?[1])
    }
}
