//! Study `random-targets`: methods on targets that nobody has tuned anything to.
//!
//! A seed makes a [`RandomTarget`](parvi_targets::RandomTarget), of which the methods know nothing, or its rough frame. Particles are
//! compared with quasi-random draws of it, in standard deviations per axis, and log Z with the exact one.

mod figure;
mod identity_frame;
mod report;

use parvi::{Method, Run};
use parvi_targets::BoxedTarget;
use serde::Deserialize;

use identity_frame::InIdentityFrame;

use super::attempt::{Attempt, attempt};
use super::checks::{distinct, not_empty};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use super::seed_range::SeedRange;
use super::yardstick::{Coordinates, CurrentYardstick, YardstickOptions, measured};
use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, TargetParameters, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling::{Outcome, sample_target};

/// All methods on random targets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct RandomTargets {
    /// Seed of every run.
    seed: u64,
    /// d.
    dims: Vec<Dimension>,
    /// The seeds that make the targets, in every dimension.
    target_seeds: SeedRange,
    /// M.
    particles: ParticleCount,
    /// What the methods know of place and scale.
    #[serde(default)]
    frame: KnownFrame,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    reference_points: Bounded<1000, 1_000_000>,
    /// Seed of the reference.
    reference_seed: u64,
    /// The methods.
    methods: Vec<MethodSpecification>,
}

/// The frame that methods get.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum KnownFrame {
    /// x = z: nothing is known.
    #[default]
    Identity,
    /// The target's: a rough guess.
    Own,
}

/// A method on a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    dim: usize,
    target_seed: u64,
    method: MethodSpecification,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("{}-{}", self.target.label(), self.method.label())
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }
}

impl RandomTargets {
    /// In standard deviations per axis; the sliced distance is not looked at.
    fn yardstick(&self) -> YardstickOptions {
        YardstickOptions::of_energy(self.reference_points.get(), self.reference_seed, Coordinates::Scaled)
    }
}

impl Study for RandomTargets {
    type Case = Case;
    type Row = RunRow;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "random-targets";
    const COLUMNS: &'static str = "case status reason dim target_seed method outcome energy_distance_squared energy_level \
         log_evidence_deviation log_evidence_error score_evaluations density_evaluations wall_seconds";

    /// The cases, target by target, so that a target's reference is made once.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("dims", &self.dims)?;
        not_empty("methods", &self.methods)?;
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for target_seed in self.target_seeds.all() {
                let mut target = TargetSpecification::plain("random", Some(dim));
                target.parameters = TargetParameters {
                    target_seed: Some(target_seed),
                    ..TargetParameters::default()
                };
                cases.extend(self.methods.iter().map(|method| Case {
                    target: target.clone(),
                    dim: dim.get(),
                    target_seed,
                    method: method.clone(),
                }));
            }
        }
        distinct("dims or methods", &cases)?;
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, CurrentYardstick>) -> Result<RunRow, CommandError> {
        let yardstick = work.shared.of(&case.target, &self.yardstick())?;
        let mut run = Run::new(self.particles.get(), self.seed);
        run.start = case.method.options.start();
        let mut row = RunRow {
            dim: case.dim,
            target_seed: Some(case.target_seed),
            method: case.method.label().to_owned(),
            energy_level: Some(yardstick.mean_distance() / run.particles as f64),
            ..RunRow::new(case)
        };
        let task = Sampled {
            frame: self.frame,
            method: &case.method.method(None)?,
            run: &run,
            observer: work.observer,
        };
        match attempt(with_target(&case.target, task))? {
            Attempt::Failed(status, reason) => row.fail(status, reason),
            Attempt::Finished(outcome) => {
                row.take(&outcome);
                row.measured(measured(yardstick, &outcome)?);
            }
        }
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

/// A run.
struct Sampled<'a> {
    frame: KnownFrame,
    method: &'a Method,
    run: &'a Run,
    observer: &'a mut CaseObserver,
}

impl TargetTask for Sampled<'_> {
    type Output = Outcome;

    fn run<const D: usize>(self, target: BoxedTarget<D>) -> Result<Self::Output, CommandError> {
        match self.frame {
            KnownFrame::Own => sample_target(target.as_ref(), self.method, self.run, self.observer),
            KnownFrame::Identity => sample_target(&InIdentityFrame(target), self.method, self.run, self.observer),
        }
    }
}
