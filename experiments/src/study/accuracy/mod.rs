//! Study `accuracy`: the energy distance from N(0, I) against the number of particles, all methods in all dimensions.
//!
//! Independent draws reach ED = O(M^(−1/2)); no set of M points can do better than the order M^(−(1 + 1/d)/2) of optimally
//! spread points. The bar between the two is scrambled Sobol points through the normal quantile.

mod figure;
mod report;

use super::checks::distinct_labels;
use super::gaussian_runs::{GaussianStudy, Setting};
use super::prelude::*;

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
    methods: Vec<MethodSpecification>,
}

impl GaussianStudy for Accuracy {
    const KIND: &'static str = "accuracy";
    const REPORT: Report<Self> = report::report;

    /// The cases, dimension by dimension, few particles first.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        all_given!(self: seeds, dims, particles, methods);
        distinct_labels(&self.methods)?;
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for &particles in &self.particles {
                for method in &self.methods {
                    cases.extend(Setting::new(dim, particles, method).cases(&self.seeds)?);
                }
            }
        }
        distinct("dims, particles or seeds", cases)
    }
}

/// ED² of as many independent draws, in expectation; of runs in one dimension.
fn expected(here: &Rows<'_>, particles: f64) -> Option<f64> {
    let row = here.first()?;
    Some(row.number("energy_level")? * row.number("particles")? / particles)
}
