//! Study `random-targets`: methods on targets that nobody has tuned anything to.
//!
//! A seed makes a [`RandomTarget`](parvi_targets::RandomTarget), of which the methods know nothing, or its rough frame. Particles are
//! compared with quasi-random draws of it, in standard deviations per axis, and log Z with the exact one.

mod figure;
mod report;

use parvi::{Method, Run};
use parvi_targets::{Frame, InFrame};
use serde::Deserialize;

use super::attempt::attempt;
use super::checks::{all_given, distinct};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use super::seed_range::SeedRange;
use super::yardstick::{Coordinates, CurrentYardstick, YardstickOptions, measured};
use crate::CommandError;
use crate::dispatch::on_target;
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

    /// Samples the target in the frame that methods get.
    fn sampled(
        &self,
        case: &Case,
        method: &Method,
        run: &Run,
        observer: &mut CaseObserver,
    ) -> Result<Outcome, CommandError> {
        on_target!(&case.target, target, D => match self.frame {
            KnownFrame::Own => sample_target::<D>(target.as_ref(), method, run, observer),
            KnownFrame::Identity => {
                let frame = Frame::identity();
                sample_target::<D>(&InFrame { target, frame }, method, run, observer)
            }
        })
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
        all_given!(self: dims, methods);
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
        let yardstick = work.shared.of(&case.target, &self.yardstick(), None)?;
        let run = case.method.run(self.particles.get(), self.seed);
        let mut row = RunRow {
            target_seed: Some(case.target_seed),
            energy_level: Some(yardstick.mean_distance() / run.particles as f64),
            ..RunRow::on(case, &case.target, &case.method)?
        };
        let method = case.method.method(None)?;
        if let Some(outcome) = row.note(attempt(self.sampled(case, &method, &run, work.observer))?) {
            row.measured(measured(yardstick, &outcome)?);
        }
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(report::report(self, rows))
    }
}
