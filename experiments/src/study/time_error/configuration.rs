//! The configuration of the study `time-error`.

use serde::Deserialize;

use super::Case;
use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, ParticleCount, StepCount, TargetSpecification};
use crate::study::checks::{distinct, not_empty};
use crate::study::yardstick::{Coordinates, YardstickOptions};

/// All methods on all targets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeError {
    #[serde(rename = "kind")]
    _kind: String,
    /// One run per seed.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// M.
    pub particles: ParticleCount,
    /// Numbers of steps for methods that take steps, unless their own options fix them; absent: each takes its own default.
    pub steps: Option<Vec<StepCount>>,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    pub reference_points: Bounded<1000, 1_000_000>,
    /// Seed of the reference points.
    pub reference_seed: u64,
    /// Directions of the sliced Wasserstein distance.
    pub directions: Bounded<1, 100_000>,
    /// Targets.
    pub targets: Vec<TargetSpecification>,
    /// Methods.
    pub methods: Vec<MethodSpecification>,
}

impl TimeError {
    /// The cases, target by target, so that a target's reference is made once.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
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

    /// Levels of independent draws are taken from the runs of `iid`.
    pub fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            points: self.reference_points.get(),
            seed: self.reference_seed,
            directions: self.directions.get(),
            coordinates: Coordinates::Own,
            independent_sets: None,
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
