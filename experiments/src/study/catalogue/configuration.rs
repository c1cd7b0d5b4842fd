//! The configuration of the study `catalogue`.

use parvi_targets::{Dimensions, TargetError, catalogue, target_info};
use serde::Deserialize;

use super::Case;
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, TargetParameters, TargetSpecification};
use crate::study::checks::{distinct, not_empty, refusal, unset};
use crate::study::start_law::StartLaw;
use crate::study::yardstick::{Coordinates, IndependentSets, YardstickOptions};

/// All methods on all targets from all starts.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Catalogue {
    #[serde(rename = "kind")]
    _kind: String,
    /// One run per seed.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// M.
    pub particles: ParticleCount,
    /// Dimensions; of each target those that it has.
    pub dims: Vec<Dimension>,
    /// Targets by name; absent: every target of the catalogue that needs no data file.
    pub targets: Option<Vec<Named>>,
    /// Where the particles begin.
    pub starts: Vec<StartLaw>,
    /// The methods; the first is judged.
    pub methods: Vec<MethodSpecification>,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    pub reference_points: Bounded<1000, 10_000_000>,
    /// Seed of the reference.
    pub reference_seed: u64,
    /// Directions of the sliced Wasserstein distance.
    pub directions: Bounded<1, 100_000>,
    /// Sets of independent draws whose median is the yardstick of that distance.
    pub draws: Bounded<1, 1000>,
}

/// A target in all its dimensions: `{ name = "gaussian", parameters = { correlation = 0.9 } }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Named {
    /// The name in the catalogue.
    pub name: String,
    /// The parameters.
    #[serde(default)]
    pub parameters: TargetParameters,
}

impl Catalogue {
    /// Every target in each of its dimensions, in the order of the list and then of `dims`.
    pub fn all_targets(&self) -> Result<Vec<TargetSpecification>, CommandError> {
        let named = match &self.targets {
            Some(named) => named.clone(),
            None => without_data(),
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

    /// The cases, target by target, so that a target's reference is made once.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        not_empty("dims", &self.dims)?;
        not_empty("starts", &self.starts)?;
        not_empty("methods", &self.methods)?;
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

    /// The level of the sliced Wasserstein distance is that of as many draws as there are particles.
    pub fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            points: self.reference_points.get(),
            seed: self.reference_seed,
            directions: self.directions.get(),
            coordinates: Coordinates::Standardised,
            independent_sets: Some(IndependentSets {
                count: self.draws.get(),
                size: self.particles.get(),
            }),
        }
    }

    /// The method that the requirements are for.
    pub fn judged(&self) -> Option<&MethodSpecification> {
        self.methods.first()
    }
}

/// The error of a target that the configuration names.
fn wrong_target(error: TargetError) -> CommandError {
    refusal("targets", error.to_string())
}

/// All targets but those whose data the user brings.
fn without_data() -> Vec<Named> {
    catalogue()
        .iter()
        .filter(|info| info.dimensions != Dimensions::FromData)
        .map(|info| Named {
            name: info.name.to_owned(),
            parameters: TargetParameters::default(),
        })
        .collect()
}
