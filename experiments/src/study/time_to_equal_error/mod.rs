//! Study `time-to-equal-error`: the wall time to the same squared energy distance, a method of M particles against its rivals.
//!
//! The method runs with its defaults; the median over the seeds of its squared energy distance e is what its rivals have to reach. A
//! Markov chain gets more and more draws, doubled from one search to the next, all of which count; its warm-up counts for its time
//! only. Other particles get more and more steps. Of n independent draws the expectation is exact, E‖Y − Y'‖/n, so that n = E‖Y − Y'‖/e
//! are needed, n/M for each particle; only the time of their exact sampler is measured. Distances are taken in coordinates in which the
//! target has mean zero and unit covariance.

mod figure;
mod report;
mod row;
mod run;
mod runs;
mod search;

use std::path::PathBuf;

use serde::Deserialize;

use row::Row;
use search::Doubling;

use super::checks::{all_given, distinct, positive, refusal, unset};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::yardstick::{Coordinates, CurrentYardstick, YardstickOptions};
use crate::CommandError;
use crate::options::{Bounded, MethodName, MethodSpecification, ParticleCount, TargetSpecification};

/// A method and its rivals, to the same error on every target.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeToEqualError {
    /// One run per seed; all that is compared are medians over them.
    seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    threads: Option<Bounded<1, 1024>>,
    /// M, one comparison each.
    particles: Vec<ParticleCount>,
    /// Draws that a Markov chain begins with and ends at, doubled in between.
    draws: Range,
    /// Steps that a rival of M particles begins with and ends at, doubled in between.
    steps: Range,
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

/// `{ from = 1000, to = 128000 }`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Range {
    from: Bounded<2, 100_000_000>,
    to: Bounded<2, 100_000_000>,
}

impl Range {
    fn check(self, field: &str) -> Result<(), CommandError> {
        if self.to < self.from {
            return Err(refusal(
                &format!("{field}.to"),
                format!("{} is below `from` = {}", self.to, self.from),
            ));
        }
        Ok(())
    }

    /// The sizes from one end to the other.
    fn doubling(self) -> Doubling {
        Doubling {
            first: self.from.get(),
            last: self.to.get(),
        }
    }
}

impl TimeToEqualError {
    /// The sliced distance is not looked at.
    fn yardstick(&self) -> YardstickOptions {
        YardstickOptions::of_energy(
            self.reference_points.get(),
            self.reference_seed,
            Coordinates::Standardised,
        )
    }
}

/// One method on one target for one M, with all seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    particles: usize,
    /// 0 for the method whose error is to be reached, then its rivals.
    index: usize,
    method: MethodSpecification,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("{}-m{}-{}", self.target.label(), self.particles, self.method.label())
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }

    fn cost(&self) -> f64 {
        // Rivals get many runs, each with a distance to the reference.
        if self.index == 0 { 1.0 } else { 10.0 }
    }
}

impl Case {
    /// The file of its runs.
    fn trials_file(&self, directory: &StudyDirectory) -> PathBuf {
        let target = self.target.label();
        directory.raw(&format!(
            "{target}-m{}-{}-{}.csv",
            self.particles, self.index, self.method.name
        ))
    }
}

impl Study for TimeToEqualError {
    type Case = Case;
    type Row = Row;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "time-to-equal-error";
    const HEAD: &[&str] = &["kind"];

    /// The cases: on every target and for every M the method first, then its rivals.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        all_given!(self: seeds, particles, targets);
        positive("largest-ratio", &[self.largest_ratio])?;
        self.draws.check("draws")?;
        self.steps.check("steps")?;
        for rival in &self.rivals {
            if !rival.name.iterates() && !matches!(rival.name, MethodName::Nuts | MethodName::Iid) {
                let message = format!("`{}` has neither steps nor draws that could be doubled", rival.name);
                return Err(refusal("rivals.name", message));
            }
            unset("rivals.options.steps", &rival.options.steps, "steps")?;
        }
        let mut cases = Vec::new();
        for target in &self.targets {
            for particles in &self.particles {
                let methods = std::iter::once(&self.method).chain(&self.rivals);
                cases.extend(methods.enumerate().map(|(index, method)| Case {
                    target: target.clone(),
                    particles: particles.get(),
                    index,
                    method: method.clone(),
                }));
            }
        }
        distinct("targets, particles or rivals", &cases)?;
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, CurrentYardstick>) -> Result<Row, CommandError> {
        let yardstick = work.shared.of(&case.target, &self.yardstick(), None)?;
        run::run(self, case, yardstick, work.directory, work.observer)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
