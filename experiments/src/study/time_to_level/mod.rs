//! Study `time-to-level`: the wall time from one start to the error of independent draws, a method against its rivals.
//!
//! Target N(0, I); the level is E‖Y − Y'‖ / M, the expected squared energy distance of M independent draws. A method is run
//! from the start with T = 1, 2, 3, … steps of the configured list until a run ends at or below the level; its time is that
//! of this one run. A rival gets as its budget a multiple of the method's time: a lower bound is a result.

mod report;

use super::contestant::Contestant;
use super::gaussian_runs::standard_yardstick;
use super::prelude::*;
use super::search::Search;
use super::start_law::StartLaw;
use super::trials::{Runs, set_by};

/// A run whose predicted time exceeds the budget by no more than this factor is begun.
const TOLERANCE: f64 = 1.2;
/// A run that takes longer than this is not repeated, in seconds.
const LONG: f64 = 1.0;
/// What is kept of a run: its steps, the sampler's time, and the squared energy distance at the end, where it did not diverge.
const RUNS: &str = "steps wall_seconds energy_distance_squared";

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
            cases.extend(here.into_iter().map(|mut case| {
                case.work.start = Some(self.start);
                // The budget of a rival is a multiple of the method's time.
                case.costing(dim.get() as f64 + 1.0)
            }));
        }
        distinct("dims or rivals", cases)
    }

    fn run(&self, case: &Case<Contestant>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let (contestant, directory) = (&case.work, tools.directory);
        let yardstick = standard_yardstick(&contestant.target, tools.yardstick)?;
        let goal = yardstick.mean_distance() / contestant.particles as f64;
        let clock = match contestant.index {
            0 => None,
            _ => set_by(&self.method, contestant, directory, RUNS)?,
        };
        let budget = clock.map(|(_, seconds)| self.largest_ratio * seconds);
        let sizes = self.steps.iter().map(|steps| steps.get()).collect();
        let search = Search::of(sizes, Status::OutOfSteps, goal, budget).lowered(TOLERANCE);
        let seeds = [self.seed];
        let mut runs = Runs::of(contestant, &seeds, yardstick, tools.observer, RUNS);
        let found = attempt(runs.reach(&search))?;
        if let Ok((Status::Reached, steps, _)) = found {
            let is_quick = runs.trials.last().is_some_and(|last| last.number(SECONDS) < Some(LONG));
            for _ in 1..self.repeats.get() * usize::from(is_quick) {
                runs.add(steps, self.seed)?;
            }
        }
        row.set("energy_level", goal);
        row.set("wall_budget_seconds", budget);
        runs.close(found, row, directory)
    }
}
