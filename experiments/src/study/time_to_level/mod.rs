//! Study `time-to-level`: the wall time from one start to the error of independent draws, a method against its rivals.
//!
//! Target N(0, I); the level is E‖Y − Y'‖ / M, the expected squared energy distance of M independent draws. A method is run
//! from the start with T = 1, 2, 3, … steps of the configured list until a run ends at or below the level; its time is that
//! of this one run. A rival gets as its budget a multiple of the method's time: a lower bound is a result.

mod report;
mod search;

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use search::Ending;

use super::checks::{all_given, distinct, positive, refusal, unset};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::gaussian_runs::energy_level;
use super::results;
use super::start_law::StartLaw;
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, StepCount};
use crate::output::table_file;

/// A method and its rivals, from the same start to the same error.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeToLevel {
    /// Seed of every run.
    seed: u64,
    /// Threads; absent: as many as the environment gives.
    threads: Option<Bounded<1, 1024>>,
    /// d.
    dims: Vec<Dimension>,
    /// M.
    particles: ParticleCount,
    /// Where all methods begin, away from the target.
    start: StartLaw,
    /// Numbers of steps to try, growing; a run begins anew with each.
    steps: Vec<StepCount>,
    /// Runs on the clock with the number of steps that reaches the level, where one takes less than a second.
    repeats: Bounded<1, 1000>,
    /// A rival stops once a run has taken this many times the time of the method.
    largest_ratio: f64,
    /// The method that sets the clock.
    method: MethodSpecification,
    /// What it is compared with.
    rivals: Vec<MethodSpecification>,
}

impl TimeToLevel {
    /// Refuses a method without steps and options that the study sets for all.
    fn check_method(&self, field: &str, method: &MethodSpecification) -> Result<(), CommandError> {
        if !method.name.iterates() {
            return Err(refusal(
                &format!("{field}.name"),
                format!("`{}` takes no steps", method.name),
            ));
        }
        unset(&format!("{field}.options.steps"), &method.options.steps, "steps")?;
        unset(
            &format!("{field}.options.start-mean"),
            &method.options.start_mean,
            "start",
        )?;
        unset(&format!("{field}.options.start-sd"), &method.options.start_sd, "start")
    }
}

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
    const HEAD: &[&str] = &["kind"];

    /// The cases: in every dimension the method first, then its rivals.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        all_given!(self: dims, steps);
        if let Some(pair) = self.steps.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(refusal("steps", format!("{} before {} do not grow", pair[0], pair[1])));
        }
        positive("largest-ratio", &[self.largest_ratio])?;
        self.start.check("start")?;
        self.check_method("method", &self.method)?;
        for rival in &self.rivals {
            self.check_method("rivals", rival)?;
        }
        let mut cases = Vec::new();
        for &dim in &self.dims {
            let methods = std::iter::once(&self.method).chain(&self.rivals);
            cases.extend(methods.enumerate().map(|(index, method)| Case {
                dim,
                particles: self.particles.get(),
                index,
                method: method.clone(),
            }));
        }
        distinct("dims or rivals", &cases)?;
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, Clock>) -> Result<Row, CommandError> {
        let level = energy_level(case.dim, case.particles)?;
        let sets_the_clock = case.index == 0;
        let budget = if sets_the_clock {
            None
        } else {
            Some(self.largest_ratio * self.clock(case.dim, work.shared, work.directory)?)
        };
        let (ending, trials) = search::search(self, case, level, budget, work.observer)?;
        table_file::write(&trials, &case.trials_file(work.directory))?;
        let [least, median, most] = search::seconds(&trials)?;
        if sets_the_clock {
            work.shared.seconds.push((case.dim, median));
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
            .cases()?
            .into_iter()
            .find(|case| case.dim == dim && case.index == 0);
        let trials = first.map_or(Ok(Vec::new()), |case| table_file::read(&case.trials_file(directory)))?;
        Ok(search::seconds(&trials)?[1])
    }
}
