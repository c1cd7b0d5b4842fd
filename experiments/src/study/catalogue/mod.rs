//! Study `catalogue`: what the defaults of a method reach on every target, from starts near and far.
//!
//! Nothing is set per target. Errors are measured in coordinates in which the target has mean zero and unit covariance, and
//! stated relative to those of as many independent draws. The first method of the list is judged by [`requirement`]; the
//! others stand beside it.

mod claims;
mod figure;
mod report;
mod requirement;

use parvi_targets::{Dimensions, TargetError, target_info};
use serde::Deserialize;

use super::checks::{all_given, distinct, refusal, targets_without_data, unset};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use super::start_law::StartLaw;
use super::yardstick::{Coordinates, CurrentYardstick, IndependentSets, YardstickOptions};
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, TargetParameters, TargetSpecification};

/// All methods on all targets from all starts.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Catalogue {
    /// One run per seed.
    seeds: Vec<u64>,
    /// M.
    particles: ParticleCount,
    /// Dimensions; of each target those that it has.
    dims: Vec<Dimension>,
    /// Targets by name; absent: every target of the catalogue that needs no data file.
    targets: Option<Vec<Named>>,
    /// Where the particles begin.
    starts: Vec<StartLaw>,
    /// The methods; the first is judged.
    methods: Vec<MethodSpecification>,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    reference_points: Bounded<1000, 10_000_000>,
    /// Seed of the reference.
    reference_seed: u64,
    /// Directions of the sliced Wasserstein distance.
    directions: Bounded<1, 100_000>,
    /// Sets of independent draws whose median is the yardstick of that distance.
    draws: Bounded<1, 1000>,
}

/// A target in all its dimensions: `{ name = "gaussian", parameters = { correlation = 0.9 } }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Named {
    /// The name in the catalogue.
    name: String,
    /// The parameters.
    #[serde(default)]
    parameters: TargetParameters,
}

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    method: MethodSpecification,
    /// `None` for draws, which have no start.
    start: Option<StartLaw>,
    particles: usize,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let start = self.start.map_or(String::new(), |start| {
            format!("-mean{}-sd{}", start.mean, start.standard_deviation)
        });
        let (target, method) = (self.target.label(), self.method.label());
        format!("{target}-{method}-m{}{start}-s{}", self.particles, self.seed)
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }

    fn cost(&self) -> f64 {
        // Milliseconds, roughly: the distance to the reference and the run; the many rows of `wells` are dear.
        let run = match self.target.name.as_str() {
            "wells" => 2000.0,
            _ => 100.0,
        };
        200.0 + if self.start.is_some() { run } else { 0.0 }
    }
}

impl Catalogue {
    /// Every target in each of its dimensions, in the order of the list and then of `dims`.
    fn all_targets(&self) -> Result<Vec<TargetSpecification>, CommandError> {
        let plain = |name: &str| Named {
            name: name.to_owned(),
            parameters: TargetParameters::default(),
        };
        let named = match &self.targets {
            Some(named) => named.clone(),
            None => targets_without_data().map(plain).collect(),
        };
        let mut targets = Vec::new();
        for Named { name, parameters } in &named {
            let here = |dim| TargetSpecification {
                name: name.clone(),
                dim,
                parameters: parameters.clone(),
            };
            let dimensions = target_info(name).map_err(wrong_target)?.dimensions;
            let mut found: Vec<TargetSpecification> = Vec::new();
            if let Dimensions::Range { minimum, maximum, .. } = dimensions {
                let inside = |dim: &&Dimension| (minimum..=maximum).contains(&dim.get());
                found.extend(self.dims.iter().filter(inside).map(|&dim| here(Some(dim))));
            } else {
                let only = here(None);
                let dimension = only.dimension().map_err(wrong_target)?;
                found.extend(self.dims.iter().any(|dim| dim.get() == dimension).then_some(only));
            }
            for target in &found {
                target.dimension().map_err(wrong_target)?;
            }
            targets.extend(found);
        }
        Ok(targets)
    }

    fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            points: self.reference_points.get(),
            seed: self.reference_seed,
            directions: self.directions.get(),
            coordinates: Coordinates::Standardised,
        }
    }

    /// The level of the sliced Wasserstein distance is that of as many draws as there are particles.
    fn sets(&self) -> IndependentSets {
        IndependentSets {
            count: self.draws.get(),
            size: self.particles.get(),
        }
    }

    /// The method that the requirements are for.
    fn judged(&self) -> Option<&MethodSpecification> {
        self.methods.first()
    }
}

/// The error of a target that the configuration names.
fn wrong_target(error: TargetError) -> CommandError {
    refusal("targets", error.to_string())
}

impl Study for Catalogue {
    type Case = Case;
    type Row = RunRow;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "catalogue";
    const COLUMNS: &'static str = "case status reason outcome target dim method start_mean start_sd particles seed energy_distance_squared \
         energy_level sliced_wasserstein sliced_level mean_error deviation_error mass_error residual steps score_evaluations \
         density_evaluations wall_seconds";

    /// The cases, target by target, so that a target's reference is made once.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        all_given!(self: seeds, dims, starts, methods);
        for start in &self.starts {
            start.check("starts")?;
        }
        for method in &self.methods {
            let options = &method.options;
            unset("methods.options.start-mean", &options.start_mean, "starts")?;
            unset("methods.options.start-sd", &options.start_sd, "starts")?;
        }
        if let Some(judged) = self.judged().filter(|judged| !judged.name.iterates()) {
            let message = format!("the first, `{}`, takes no steps, so it has no starts", judged.name);
            return Err(refusal("methods", message));
        }
        let targets = self.all_targets()?;
        if targets.is_empty() {
            return Err(refusal("targets", "none of them has one of the dimensions in `dims`"));
        }
        let mut cases = Vec::new();
        for target in &targets {
            for method in &self.methods {
                let starts: Vec<Option<StartLaw>> = match method.name.iterates() {
                    true => self.starts.iter().copied().map(Some).collect(),
                    false => vec![None],
                };
                for start in starts {
                    cases.extend(self.seeds.iter().map(|&seed| Case {
                        target: target.clone(),
                        method: method.clone(),
                        start,
                        particles: self.particles.get(),
                        seed,
                    }));
                }
            }
        }
        distinct("targets, dims, methods, starts or seeds", &cases)?;
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, CurrentYardstick>) -> Result<RunRow, CommandError> {
        let yardstick = work.shared.of(&case.target, &self.yardstick(), Some(self.sets()))?;
        let mut row = RunRow {
            start_mean: case.start.map(|start| start.mean),
            start_sd: case.start.map(|start| start.standard_deviation),
            particles: case.particles,
            seed: Some(case.seed),
            energy_level: Some(yardstick.mean_distance() / case.particles as f64),
            sliced_level: yardstick.sliced_level(),
            ..RunRow::on(case, &case.target, &case.method)?
        };
        let mut run = case.method.run(case.particles, case.seed);
        run.start = case.start.map_or(run.start, |law| law.start(run.start));
        let method = case.method.method(None)?;
        row.run(&case.target, &method, &run, yardstick, work.observer)?;
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows)
    }
}

/// The runs of a method on a target from a start; those without a start belong to every one.
fn runs<'a>(rows: &'a [RunRow], target: &str, method: &str, start: Option<StartLaw>) -> Vec<&'a RunRow> {
    rows.iter()
        .filter(|row| row.target == target && row.method == method)
        .filter(|row| row.start_mean.is_none() || is_from(row, start))
        .collect()
}

fn is_from(row: &RunRow, start: Option<StartLaw>) -> bool {
    let law = start.map(|law| (law.mean, law.standard_deviation));
    row.start_mean.zip(row.start_sd) == law
}
