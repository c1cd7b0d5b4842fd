//! Study `time-to-equal-error`: the wall time to the same squared energy distance, a method of M particles against its rivals.
//!
//! The method runs with its defaults; the median over the seeds of its squared energy distance e is what its rivals have to reach. A
//! Markov chain gets more and more draws, doubled from one search to the next, all of which count; its warm-up counts for its time
//! only. Other particles get more and more steps. Of n independent draws the expectation is exact, E‖Y − Y'‖/n, so that n = E‖Y − Y'‖/e
//! are needed, n/M for each particle; only the time of their exact sampler is measured. Distances are taken in coordinates in which the
//! target has mean zero and unit covariance.

mod report;

use super::contestant::Contestant;
use super::prelude::*;
use super::search::{Doubled, Search};
use super::trials::{Runs, set_by};

/// What is kept of a run: draws, or the steps of a method that takes steps, 0 for its own number; its seed; what it took; and what it reached.
const RUNS: &str = "size seed score_evaluations density_evaluations wall_seconds energy_distance_squared";

/// A method and its rivals, to the same error on every target.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeToEqualError {
    /// One run per seed; all that is compared are medians over them.
    seeds: Vec<u64>,
    /// M, one comparison each.
    particles: Vec<ParticleCount>,
    /// Draws that a Markov chain begins with and ends at, doubled in between.
    draws: Doubled,
    /// Steps that a rival of M particles begins with and ends at, doubled in between.
    steps: Doubled,
    /// A rival stops once its median run has taken this many times the time of the method.
    largest_ratio: f64,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    reference_points: Bounded<1000, 10_000_000>,
    /// Seed of the reference.
    reference_seed: u64,
    /// Targets.
    targets: Vec<TargetSpecification>,
    /// The method whose error is to be reached.
    method: MethodSpecification,
    /// What it is compared with.
    rivals: Vec<MethodSpecification>,
}

impl Study for TimeToEqualError {
    type Work = Contestant;

    const KIND: &'static str = "time-to-equal-error";
    const COLUMNS: &'static str = "case ending reason target dim particles method mean_distance goal size score_evaluations \
         density_evaluations energy_distance_squared wall_seconds wall_seconds_least wall_seconds_most missed_size wall_seconds_missed \
         reference_size reference_mean_error reference_deviation_error";
    const REPORT: Report<Self> = report::report;

    /// The cases: on every target and for every M the method first, then its rivals.
    fn cases(&self) -> Result<Vec<Case<Contestant>>, CommandError> {
        all_given!(self: seeds, particles, targets);
        positive("largest-ratio", &[self.largest_ratio])?;
        self.draws.check("draws")?;
        self.steps.check("steps")?;
        for MethodSpecification { name, options, .. } in &self.rivals {
            let doubles = name.iterates() || matches!(name, MethodName::Nuts | MethodName::Iid);
            let otherwise = || format!("`{name}` has neither steps nor draws that could be doubled");
            holds(doubles, "rivals.name", otherwise)?;
            unset("rivals.options.steps", &options.steps, "steps")?;
        }
        let mut cases = Vec::new();
        for target in &self.targets {
            for particles in &self.particles {
                let (name, particles) = (target.label(), particles.get());
                let (task, methods) = (format!("{name}-m{particles}"), (&self.method, &self.rivals[..]));
                cases.extend(Contestant::all((&name, &task), (target, particles), methods)?);
            }
        }
        distinct("targets, particles or rivals", cases)
    }

    fn run(&self, case: &Case<Contestant>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let (entry, directory) = (&case.work, tools.directory);
        // The sliced distance is not looked at.
        let (points, seed) = (self.reference_points.get(), self.reference_seed);
        let options = YardstickOptions::of_energy(points, seed, Coordinates::Standardised);
        let yardstick = tools.yardstick.of(&entry.target, &options, row)?;
        row.set("mean_distance", yardstick.mean_distance());
        let mut runs = Runs::of(entry, &self.seeds, yardstick, tools.observer, RUNS);
        if entry.index == 0 {
            let found = attempt(runs.own())?;
            return runs.close(found, row, directory);
        }
        let set = set_by(&self.method, entry, directory, RUNS)?;
        let Some((goal, seconds)) = set.filter(|(goal, _)| *goal > 0.0 && goal.is_finite()) else {
            let reason = "the method that sets the error has none above 0";
            return runs.close(Err(Failure::new(Status::Unsupported, reason)), row, directory);
        };
        row.set("goal", goal);
        let (mut sizes, budget) = (self.steps, Some(self.largest_ratio * seconds));
        if !entry.method.name.iterates() {
            sizes = self.draws;
            runs.trials = self.earlier(entry, directory)?;
        }
        let search = Search::of(sizes.sizes(), Status::OutOfSizes, goal, budget);
        let found = attempt(runs.reach(&search))?;
        runs.close(found, row, directory)
    }
}

impl TimeToEqualError {
    /// The runs of the same rival for smaller M: draws do not depend on it, so they are not made twice.
    fn earlier(&self, entry: &Contestant, directory: &StudyDirectory) -> Result<Vec<Row>, CommandError> {
        let is_same = |other: &Contestant| other.target == entry.target && other.index == entry.index;
        let cases = self.cases()?.into_iter().map(|case| case.work);
        let earlier = cases.take_while(|other| other.task != entry.task).filter(is_same);
        let known: Result<Vec<_>, _> = earlier.map(|other| other.trials(directory, RUNS)).collect();
        Ok(known?.into_iter().max_by_key(Vec::len).unwrap_or_default())
    }
}
