//! The configuration of the study `random-targets`.

use serde::Deserialize;

use super::Case;
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, TargetParameters, TargetSpecification};
use crate::study::checks::{distinct, not_empty};
use crate::study::yardstick::{Coordinates, YardstickOptions};

/// All methods on random targets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct RandomTargets {
    #[serde(rename = "kind")]
    _kind: String,
    /// Seed of every run.
    pub seed: u64,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// d.
    pub dims: Vec<Dimension>,
    /// The seeds that make the targets, in every dimension.
    pub target_seeds: SeedRange,
    /// M.
    pub particles: ParticleCount,
    /// What the methods know of place and scale.
    #[serde(default)]
    pub frame: KnownFrame,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    pub reference_points: Bounded<1000, 1_000_000>,
    /// Seed of the reference.
    pub reference_seed: u64,
    /// The methods.
    pub methods: Vec<MethodSpecification>,
}

/// Consecutive seeds.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeedRange {
    /// The first.
    pub first: u32,
    /// Their number.
    pub count: Bounded<1, 1_000_000>,
}

/// The frame that methods get.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum KnownFrame {
    /// x = z: nothing is known.
    #[default]
    Identity,
    /// The target's: a rough guess.
    Own,
}

impl RandomTargets {
    /// The cases, target by target, so that a target's reference is made once.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("dims", &self.dims)?;
        not_empty("methods", &self.methods)?;
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for target_seed in (u64::from(self.target_seeds.first)..).take(self.target_seeds.count.get()) {
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

    /// In standard deviations per axis; the sliced distance is not looked at.
    pub fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            points: self.reference_points.get(),
            seed: self.reference_seed,
            directions: 1,
            coordinates: Coordinates::Scaled,
            independent_sets: None,
        }
    }
}
