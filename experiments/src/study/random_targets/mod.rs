//! Study `random-targets`: methods on targets that nobody has tuned anything to.
//!
//! A seed makes a [`RandomTarget`](parvi_targets::RandomTarget), of which the methods know nothing, or its rough frame. Particles are
//! compared with quasi-random draws of it, in standard deviations per axis, and log Z with the exact one.

mod report;

use parvi_files::Outcome;
use parvi_targets::Frame;

use super::prelude::*;
use super::seed_range::SeedRange;
use crate::dispatch::on_target;
use crate::sampling::sample_target;

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

impl RandomTargets {
    /// Samples the target in the frame that methods get.
    fn sampled(&self, work: &Sampled, observer: &mut Bar) -> Result<Outcome, CommandError> {
        let Sampled { target, method, run } = work;
        on_target!(target, target, D => {
            let frame = match self.frame {
                KnownFrame::Own => target.frame(),
                KnownFrame::Identity => Frame::identity(),
            };
            sample_target::<D>(target.as_ref(), &frame, method, run, observer)
        })
    }
}

impl Study for RandomTargets {
    type Work = Sampled;

    const KIND: &'static str = "random-targets";
    const COLUMNS: &'static str = "case status reason dim target_seed method outcome energy_distance_squared energy_level \
         log_evidence_deviation log_evidence_error score_evaluations density_evaluations wall_seconds";
    const REPORT: Report<Self> = report::report;

    /// The cases, target by target, so that a target's reference is made once.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        all_given!(self: dims, methods);
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for target_seed in self.target_seeds.all() {
                let mut target = TargetSpecification::plain("random", Some(dim));
                target.parameters.target_seed = Some(target_seed);
                for method in &self.methods {
                    let work = Sampled::new(&target, method, None, (self.particles.get(), self.seed))?;
                    let case = work.case(format!("{}-{}", target.label(), method.label()), method)?;
                    cases.push(case.with("target_seed", target_seed));
                }
            }
        }
        distinct("dims or methods", cases)
    }

    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        // In standard deviations per axis; the sliced distance is not looked at.
        let options =
            YardstickOptions::of_energy(self.reference_points.get(), self.reference_seed, Coordinates::Scaled);
        let yardstick = tools.yardstick.of(&case.work.target, &options, row)?;
        row.set("energy_level", yardstick.mean_distance() / self.particles.get() as f64);
        if let Some(outcome) = row.note(self.sampled(&case.work, tools.observer))? {
            row.measured(yardstick.measure(&outcome.particles))?;
        }
        Ok(())
    }
}
