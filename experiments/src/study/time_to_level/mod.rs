//! Study `time-to-level`: the wall time from one start to the error of independent draws, a method against its rivals.
//!
//! Target N(0, I); the level is E‖Y − Y'‖ / M, the expected squared energy distance of M independent draws. A method is run
//! from the start with T = 1, 2, 3, … steps of the configured list until a run ends at or below the level; its time is that
//! of this one run. A rival gets as its budget a multiple of the method's time: a lower bound is a result.

mod report;
mod search;

use super::contestant::Contestant;
use super::gaussian_runs::energy_level;
use super::prelude::*;
use super::start_law::StartLaw;

/// A method and its rivals, from the same start to the same error.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeToLevel {
    /// Seed of every run.
    seed: u64,
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
        let MethodSpecification { name, options, .. } = method;
        holds(name.iterates(), &format!("{field}.name"), || {
            format!("`{name}` takes no steps")
        })?;
        unset(&format!("{field}.options.steps"), &options.steps, "steps")?;
        unset(&format!("{field}.options.start-mean"), &options.start_mean, "start")?;
        unset(&format!("{field}.options.start-sd"), &options.start_sd, "start")
    }
}

impl Study for TimeToLevel {
    type Work = Contestant;

    const KIND: &'static str = "time-to-level";
    const COLUMNS: &'static str = "case ending dim particles method energy_level runs steps energy_distance_squared wall_seconds \
         wall_seconds_least wall_seconds_most wall_budget_seconds";
    const REPORT: Report<Self> = report::report;

    /// The cases: in every dimension the method first, then its rivals.
    fn cases(&self) -> Result<Vec<Case<Contestant>>, CommandError> {
        all_given!(self: dims, steps);
        for pair in self.steps.windows(2) {
            let otherwise = || format!("{} before {} do not grow", pair[0], pair[1]);
            holds(pair[0] < pair[1], "steps", otherwise)?;
        }
        positive("largest-ratio", &[self.largest_ratio])?;
        self.start.check("start")?;
        self.check_method("method", &self.method)?;
        for rival in &self.rivals {
            self.check_method("rivals", rival)?;
        }
        let mut cases = Vec::new();
        for &dim in &self.dims {
            let target = TargetSpecification::plain("gaussian", Some(dim));
            let (task, methods) = (format!("d{dim}"), (&self.method, &self.rivals[..]));
            let here = Contestant::all((&task, &task), (&target, self.particles.get()), methods)?;
            // The budget of a rival is a multiple of the method's time.
            cases.extend(here.into_iter().map(|case| case.costing(dim.get() as f64 + 1.0)));
        }
        distinct("dims or rivals", cases)
    }

    fn run(&self, case: &Case<Contestant>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let (contestant, directory) = (&case.work, tools.directory);
        let level = energy_level(contestant.target.dimension()?, contestant.particles)?;
        let mut budget = None;
        if contestant.index > 0 {
            let trials = contestant.first(&self.method).trials(directory, search::COLUMNS)?;
            let seconds = search::last(&trials).median(SECONDS);
            budget = seconds.map(|seconds| self.largest_ratio * seconds);
        }
        let (ending, trials) = search::search(self, contestant, (level, budget), tools.observer)?;
        row_file::write(&contestant.file(directory), search::COLUMNS, &trials)?;
        let last = search::last(&trials);
        row.set("ending", ending);
        row.set("energy_level", level);
        row.set("runs", trials.len());
        row.set("steps", trials.last().map_or(Some(0), |trial| trial.count("steps")));
        row.set(ENERGY, trials.last().and_then(|trial| trial.number(ENERGY)));
        last.note_range(SECONDS, row, WALL);
        row.set("wall_budget_seconds", budget);
        Ok(())
    }
}
