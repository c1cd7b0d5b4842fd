//! The configuration of the study `time-error`.

use std::collections::HashSet;

use serde::Deserialize;

use super::Case;
use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, ParticleCount, StepCount, TargetSpecification};
use crate::study::definition;

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
    /// Numbers of steps for methods that take steps, unless their own options fix them.
    pub steps: Vec<StepCount>,
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
        let refuse = |field: &str, message: &str| {
            Err(CommandError::ConfigField {
                file: String::new(),
                field: field.to_owned(),
                message: message.to_owned(),
            })
        };
        if self.seeds.is_empty() {
            return refuse("seeds", "is empty");
        }
        if self.steps.is_empty() {
            return refuse("steps", "is empty");
        }
        let mut cases = Vec::new();
        let mut ids = HashSet::new();
        for (target_index, target) in self.targets.iter().enumerate() {
            for method in &self.methods {
                for steps in self.sweep(method) {
                    for &seed in &self.seeds {
                        let (target, method) = (target.clone(), method.clone());
                        let particles = self.particles.get();
                        let case = Case {
                            target_index,
                            target,
                            method,
                            particles,
                            steps,
                            seed,
                        };
                        if !ids.insert(definition::Case::id(&case)) {
                            return refuse("methods", &format!("two cases are `{}`", definition::Case::id(&case)));
                        }
                        cases.push(case);
                    }
                }
            }
        }
        Ok(cases)
    }

    /// The numbers of steps of one method; `None` for draws.
    fn sweep(&self, method: &MethodSpecification) -> Vec<Option<usize>> {
        if !method.name.iterates() {
            return vec![None];
        }
        match method.options.steps {
            Some(steps) => vec![Some(steps.get())],
            None => self.steps.iter().map(|steps| Some(steps.get())).collect(),
        }
    }
}
