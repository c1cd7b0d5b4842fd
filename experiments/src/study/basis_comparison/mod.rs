//! Study `basis-comparison`: which basis gives the smallest energy distance from N(0, I) for its time.
//!
//! A basis with few nodes per particle has cheap steps, a smooth one needs fewer or resolves more. Each basis is run at
//! several spacings and numbers of steps; its best spacing at the largest number of steps stands for it.

mod choice;
mod report;

use super::gaussian_runs::{GaussianStudy, Setting, default_spacing};
use super::prelude::*;

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
    const REPORT: Report<Self> = report::report;

    /// The cases, dimension by dimension.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
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
                        fitting("method", &method)?;
                        let setting = Setting {
                            series: basis.to_string(),
                            spacing_factor: Some(factor),
                            ..Setting::new(dim, self.particles, &method)
                        };
                        cases.extend(setting.cases(&self.seeds)?);
                    }
                }
            }
        }
        distinct("seeds, dims, bases, spacings or steps", cases)
    }
}
