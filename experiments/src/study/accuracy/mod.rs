//! Study `accuracy`: the energy distance from N(0, I) against the number of particles, all methods in all dimensions.
//!
//! Independent draws reach ED = O(M^(−1/2)); no set of M points can do better than the order M^(−(1 + 1/d)/2) of optimally
//! spread points. The bar between the two is scrambled Sobol points through the normal quantile.

mod figure;
mod report;

use super::gaussian_runs::{GaussianStudy, Setting};
use super::prelude::*;
use crate::options::OptionError;

/// All methods in all dimensions at all numbers of particles.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Accuracy {
    /// One run per seed.
    seeds: Vec<u64>,
    /// d.
    dims: Vec<Dimension>,
    /// M.
    particles: Vec<ParticleCount>,
    /// The methods.
    methods: Vec<Entry>,
}

/// A method and how far it is taken: `{ name = "svgd", label = "Stein", options = { … }, largest-particles = 2048 }`.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Stated")]
struct Entry {
    /// The method.
    method: MethodSpecification,
    /// The largest M at which it runs; `None`: all.
    largest_particles: Option<ParticleCount>,
}

/// What the configuration says, before it is checked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Stated {
    name: MethodName,
    label: Option<String>,
    #[serde(default)]
    options: MethodOptions,
    largest_particles: Option<ParticleCount>,
}

impl TryFrom<Stated> for Entry {
    type Error = OptionError;

    fn try_from(stated: Stated) -> Result<Self, OptionError> {
        let method = MethodSpecification {
            name: stated.name,
            label: stated.label,
            options: stated.options,
        };
        method.check()?;
        let largest_particles = stated.largest_particles;
        Ok(Self {
            method,
            largest_particles,
        })
    }
}

impl GaussianStudy for Accuracy {
    const KIND: &'static str = "accuracy";
    const REPORT: Report<Self> = report::report;

    /// The cases, dimension by dimension, few particles first.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        all_given!(self: seeds, dims, particles, methods);
        let mut labels: Vec<&str> = self.methods.iter().map(|entry| entry.method.label()).collect();
        labels.sort_unstable();
        if let Some(pair) = labels.windows(2).find(|pair| pair[0] == pair[1]) {
            let message = format!("two are called `{}`; give one of them a `label` of its own", pair[0]);
            return Err(refusal("methods", message));
        }
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for &particles in &self.particles {
                let within = |entry: &&Entry| entry.largest_particles.is_none_or(|most| particles <= most);
                for Entry { method, .. } in self.methods.iter().filter(within) {
                    cases.extend(Setting::new(dim, particles, method).cases(&self.seeds)?);
                }
            }
        }
        distinct("dims, particles or seeds", &cases)?;
        Ok(cases)
    }
}

impl Accuracy {
    /// The methods' names in tables and figures.
    fn labels(&self) -> impl Iterator<Item = &str> {
        self.methods.iter().map(|entry| entry.method.label())
    }
}

/// ED² of as many independent draws, in expectation; of runs in one dimension.
fn expected(here: &Rows<'_>, particles: f64) -> Option<f64> {
    let row = here.first()?;
    Some(row.number("energy_level")? * row.number("particles")? / particles)
}
