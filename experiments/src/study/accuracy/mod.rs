//! Study `accuracy`: the energy distance from N(0, I) against the number of particles, all methods in all dimensions.
//!
//! Independent draws reach ED = O(M^(−1/2)); no set of M points can do better than the order M^(−(1 + 1/d)/2) of optimally
//! spread points. The bar between the two is scrambled Sobol points through the normal quantile.

mod figure;
mod report;

use serde::Deserialize;

use super::checks::{all_given, distinct, refusal};
use super::definition::Report;
use super::gaussian_runs::{Case, GaussianStudy};
use super::run_row::RunRow;
use crate::CommandError;
use crate::options::{Dimension, MethodName, MethodOptions, MethodSpecification, OptionError, ParticleCount};

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
        let method = MethodSpecification::new(stated.name, stated.label, stated.options)?;
        Ok(Self {
            method,
            largest_particles: stated.largest_particles,
        })
    }
}

impl GaussianStudy for Accuracy {
    const KIND: &'static str = "accuracy";

    /// The cases, dimension by dimension, few particles first.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
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
                for entry in self.methods.iter().filter(within) {
                    let case = Case {
                        dim,
                        particles: particles.get(),
                        series: entry.method.label().to_owned(),
                        method: entry.method.clone(),
                        spacing_factor: None,
                        seed: 0,
                    };
                    cases.extend(case.of_seeds(&self.seeds));
                }
            }
        }
        distinct("dims, particles or seeds", &cases)?;
        Ok(cases)
    }

    fn report(&self, rows: &[RunRow]) -> Report {
        report::report(self, rows)
    }
}

/// The runs of one method at one size.
fn runs<'a>(rows: &'a [RunRow], dim: Dimension, particles: usize, label: &str) -> Vec<&'a RunRow> {
    rows.iter()
        .filter(|row| row.dim == dim.get() && row.particles == particles && row.series == label)
        .collect()
}

/// ED² of as many independent draws, in expectation.
fn expected(rows: &[RunRow], dim: Dimension, particles: f64) -> Option<f64> {
    let row = rows.iter().find(|row| row.dim == dim.get())?;
    Some(row.energy_level? * row.particles as f64 / particles)
}
