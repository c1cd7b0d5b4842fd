//! Study `basis-comparison`: which basis gives the smallest energy distance from N(0, I) for its time.
//!
//! A basis with few nodes per particle has cheap steps, a smooth one needs fewer or resolves more. Each basis is run at
//! several spacings and numbers of steps; its best spacing at the largest number of steps stands for it.

mod choice;
mod report;

use serde::Deserialize;

use super::checks::{all_given, ascending, distinct, options_fit, positive, unset};
use super::definition::Report;
use super::gaussian_runs::{Case, GaussianStudy, default_spacing};
use super::run_row::RunRow;
use crate::CommandError;
use crate::options::{Basis, Dimension, MethodSpecification, ParticleCount, StepCount};

/// All bases at several spacings and numbers of steps.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct BasisComparison {
    /// One run per seed.
    seeds: Vec<u64>,
    /// d.
    dims: Vec<Dimension>,
    /// M.
    particles: ParticleCount,
    /// The bases; the time of the first one is what the others get in the comparison at equal time.
    bases: Vec<Basis>,
    /// Spacings in units of each basis's own default.
    spacings: Vec<f64>,
    /// Numbers of steps.
    steps: Vec<StepCount>,
    /// The sampler with all other options.
    method: MethodSpecification,
}

impl BasisComparison {
    /// The numbers of steps, few first.
    fn step_counts(&self) -> Vec<usize> {
        ascending(&self.steps)
    }
}

impl GaussianStudy for BasisComparison {
    const KIND: &'static str = "basis-comparison";

    /// The cases, dimension by dimension.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        all_given!(self: seeds, dims, bases, spacings, steps);
        positive("spacings", &self.spacings)?;
        let options = &self.method.options;
        unset("method.options.basis", &options.basis, "bases")?;
        unset("method.options.spacing", &options.spacing, "spacings")?;
        unset("method.options.steps", &options.steps, "steps")?;
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for &basis in &self.bases {
                let default = default_spacing(dim, basis, self.particles.get())?;
                for &factor in &self.spacings {
                    for &steps in &self.steps {
                        let mut method = self.method.clone();
                        method.options.basis = Some(basis);
                        method.options.spacing = Some(factor * default);
                        method.options.steps = Some(steps);
                        options_fit("method", &method)?;
                        let case = Case {
                            dim,
                            particles: self.particles.get(),
                            series: basis.to_string(),
                            method,
                            spacing_factor: Some(factor),
                            seed: 0,
                        };
                        cases.extend(case.of_seeds(&self.seeds));
                    }
                }
            }
        }
        distinct("seeds, dims, bases, spacings or steps", &cases)?;
        Ok(cases)
    }

    fn report(&self, rows: &[RunRow]) -> Report {
        report::report(self, rows)
    }
}
