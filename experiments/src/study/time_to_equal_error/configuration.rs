//! The configuration of the study `time-to-equal-error`.

use serde::Deserialize;

use super::Case;
use super::search::Doubling;
use crate::CommandError;
use crate::options::{Bounded, MethodName, MethodSpecification, ParticleCount, TargetSpecification};
use crate::study::checks::{distinct, not_empty, positive, refusal, unset};
use crate::study::yardstick::{Coordinates, YardstickOptions};

/// A method and its rivals, to the same error on every target.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeToEqualError {
    #[serde(rename = "kind")]
    _kind: String,
    /// One run per seed; all that is compared are medians over them.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// M, one comparison each.
    pub particles: Vec<ParticleCount>,
    /// Draws that a Markov chain begins with and ends at, doubled in between.
    pub draws: Range,
    /// Steps that a rival of M particles begins with and ends at, doubled in between.
    pub steps: Range,
    /// A rival stops once its median run has taken this many times the time of the method.
    pub largest_ratio: f64,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    pub reference_points: Bounded<1000, 10_000_000>,
    /// Seed of the reference.
    pub reference_seed: u64,
    /// Targets.
    pub targets: Vec<TargetSpecification>,
    /// The method whose error is to be reached.
    pub method: MethodSpecification,
    /// What it is compared with.
    pub rivals: Vec<MethodSpecification>,
}

/// `{ from = 1000, to = 128000 }`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
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
    pub fn doubling(self) -> Doubling {
        Doubling {
            first: self.from.get(),
            last: self.to.get(),
        }
    }
}

impl TimeToEqualError {
    /// The cases: on every target and for every M the method first, then its rivals.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        not_empty("particles", &self.particles)?;
        not_empty("targets", &self.targets)?;
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

    /// The sliced distance is not looked at.
    pub fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            points: self.reference_points.get(),
            seed: self.reference_seed,
            directions: 1,
            coordinates: Coordinates::Standardised,
            independent_sets: None,
        }
    }
}
