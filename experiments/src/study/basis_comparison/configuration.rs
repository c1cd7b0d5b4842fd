//! The configuration of the study `basis-comparison`.

use serde::Deserialize;

use crate::CommandError;
use crate::options::{Basis, Bounded, Dimension, MethodSpecification, ParticleCount, StepCount};
use crate::study::checks::{distinct, not_empty, options_fit, positive, unset};
use crate::study::gaussian_runs::{Case, GaussianPlan, default_spacing};

/// All bases at several spacings and numbers of steps.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct BasisComparison {
    #[serde(rename = "kind")]
    _kind: String,
    /// One run per seed.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    threads: Option<Bounded<1, 1024>>,
    /// d.
    pub dims: Vec<Dimension>,
    /// M.
    pub particles: ParticleCount,
    /// The bases; the time of the first one is what the others get in the comparison at equal time.
    pub bases: Vec<Basis>,
    /// Spacings in units of each basis's own default.
    pub spacings: Vec<f64>,
    /// Numbers of steps.
    pub steps: Vec<StepCount>,
    /// The sampler with all other options.
    pub method: MethodSpecification,
}

impl BasisComparison {
    /// The numbers of steps, few first.
    pub fn step_counts(&self) -> Vec<usize> {
        let mut steps: Vec<usize> = self.steps.iter().map(|steps| steps.get()).collect();
        steps.sort_unstable();
        steps
    }
}

impl GaussianPlan for BasisComparison {
    fn seeds(&self) -> &[u64] {
        &self.seeds
    }

    fn threads(&self) -> Option<Bounded<1, 1024>> {
        self.threads
    }

    /// The cases, dimension by dimension.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        not_empty("dims", &self.dims)?;
        not_empty("bases", &self.bases)?;
        not_empty("spacings", &self.spacings)?;
        not_empty("steps", &self.steps)?;
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
                        cases.extend(self.seeds.iter().map(|&seed| Case {
                            dim,
                            particles: self.particles.get(),
                            series: basis.to_string(),
                            method: method.clone(),
                            spacing_factor: Some(factor),
                            seed,
                        }));
                    }
                }
            }
        }
        distinct("seeds, dims, bases, spacings or steps", &cases)?;
        Ok(cases)
    }
}
