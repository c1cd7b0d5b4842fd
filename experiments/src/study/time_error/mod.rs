//! Study `time-error`: error against wall time and evaluations, all methods on all targets.
//!
//! The yardstick is a set of independent exact draws of the same size M; where a target has none, they are drawn
//! from its reference draws. A run that diverges is a row with its reason.

mod groups;
mod report;

use serde::Deserialize;

use super::checks::{distinct, not_empty};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use super::yardstick::{Coordinates, CurrentYardstick, YardstickOptions};
use crate::CommandError;
use crate::options::{Bounded, MethodName, MethodSpecification, ParticleCount, StepCount, TargetSpecification};

/// All methods on all targets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeError {
    /// One run per seed.
    seeds: Vec<u64>,
    /// M.
    particles: ParticleCount,
    /// Numbers of steps for methods that take steps, unless their own options fix them; absent: each takes its own default.
    steps: Option<Vec<StepCount>>,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    reference_points: Bounded<1000, 1_000_000>,
    /// Seed of the reference points.
    reference_seed: u64,
    /// Directions of the sliced Wasserstein distance.
    directions: Bounded<1, 100_000>,
    /// Targets.
    targets: Vec<TargetSpecification>,
    /// Methods.
    methods: Vec<MethodSpecification>,
}

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    method: MethodSpecification,
    particles: usize,
    steps: Option<usize>,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let steps = self.steps.map_or(String::new(), |steps| format!("-t{steps}"));
        format!(
            "{}-{}-m{}{steps}-s{}",
            self.target.label(),
            self.method.label(),
            self.particles,
            self.seed
        )
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }

    fn cost(&self) -> f64 {
        // Milliseconds, roughly: a distance to the reference, and M² pairs or M · 3ᵈ nodes per step.
        let steps = self.steps.unwrap_or(0) as f64;
        let dimension = self.target.dimension().unwrap_or(1) as i32;
        let per_step = match self.method.name {
            MethodName::Svgd => 10.0,
            _ => 0.03 * 3f64.powi(dimension),
        };
        100.0 + per_step * steps
    }
}

impl TimeError {
    /// Levels of independent draws are taken from the runs of `iid`.
    fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            points: self.reference_points.get(),
            seed: self.reference_seed,
            directions: self.directions.get(),
            coordinates: Coordinates::Own,
        }
    }

    /// The numbers of steps of one method; `None`: its own, or draws.
    fn sweep(&self, method: &MethodSpecification) -> Vec<Option<usize>> {
        if !method.name.iterates() {
            return vec![None];
        }
        match (method.options.steps, &self.steps) {
            (Some(steps), _) => vec![Some(steps.get())],
            (None, Some(steps)) => steps.iter().map(|steps| Some(steps.get())).collect(),
            (None, None) => vec![None],
        }
    }
}

impl Study for TimeError {
    type Case = Case;
    type Row = RunRow;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "time-error";
    const COLUMNS: &'static str = "case status note target dim method particles steps seed score_evaluations density_evaluations \
         wall_seconds energy_distance_squared energy_level sliced_wasserstein mean_error deviation_error mass_error residual";

    /// The cases, target by target, so that a target's reference is made once.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        if let Some(steps) = &self.steps {
            not_empty("steps", steps)?;
        }
        let mut cases = Vec::new();
        for target in &self.targets {
            for method in &self.methods {
                for steps in self.sweep(method) {
                    for &seed in &self.seeds {
                        let (target, method) = (target.clone(), method.clone());
                        let particles = self.particles.get();
                        cases.push(Case {
                            target,
                            method,
                            particles,
                            steps,
                            seed,
                        });
                    }
                }
            }
        }
        distinct("targets, methods, steps or seeds", &cases)?;
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, CurrentYardstick>) -> Result<RunRow, CommandError> {
        let yardstick = work.shared.of(&case.target, &self.yardstick(), None)?;
        let mut row = RunRow {
            particles: case.particles,
            seed: Some(case.seed),
            energy_level: Some(yardstick.mean_distance() / case.particles as f64),
            ..RunRow::on(case, &case.target, &case.method)?
        };
        let run = case.method.run(case.particles, case.seed);
        let method = case.method.method(case.steps)?;
        let drawn_from_sample = row.run(&case.target, &method, &run, yardstick, work.observer)?;
        if drawn_from_sample && row.finished() {
            row.note = "drawn from the importance sample".to_owned();
        }
        // Diverged runs keep the steps they were asked for, as finished ones do.
        row.steps = case.steps;
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(report::report(self, rows))
    }
}
