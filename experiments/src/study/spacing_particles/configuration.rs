//! The configuration of the study `spacing-particles`.

use serde::Deserialize;

use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount};
use crate::study::checks::{distinct, not_empty, options_fit, positive, unset};
use crate::study::gaussian_runs::{Case, GaussianPlan};

/// All pairs of a spacing and a number of particles, one series of spacings per dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SpacingParticles {
    #[serde(rename = "kind")]
    _kind: String,
    /// One run per seed.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    threads: Option<Bounded<1, 1024>>,
    /// M.
    pub particles: Vec<ParticleCount>,
    /// The sampler; its spacing comes from the series.
    pub method: MethodSpecification,
    /// One per dimension.
    pub series: Vec<Series>,
}

/// The spacings of one dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Series {
    /// d.
    pub dim: Dimension,
    /// Spacings h in standard deviations.
    pub spacings: Vec<f64>,
}

impl Series {
    /// The spacings, fine ones first.
    pub fn sorted(&self) -> Vec<f64> {
        let mut spacings = self.spacings.clone();
        spacings.sort_by(f64::total_cmp);
        spacings
    }
}

impl SpacingParticles {
    /// The numbers of particles, few first.
    pub fn counts(&self) -> Vec<usize> {
        let mut counts: Vec<usize> = self.particles.iter().map(|count| count.get()).collect();
        counts.sort_unstable();
        counts
    }
}

impl GaussianPlan for SpacingParticles {
    fn seeds(&self) -> &[u64] {
        &self.seeds
    }

    fn threads(&self) -> Option<Bounded<1, 1024>> {
        self.threads
    }

    /// The cases, dimension by dimension.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        not_empty("particles", &self.particles)?;
        not_empty("series", &self.series)?;
        unset("method.options.spacing", &self.method.options.spacing, "series")?;
        let mut cases = Vec::new();
        for series in &self.series {
            not_empty("series.spacings", &series.spacings)?;
            positive("series.spacings", &series.spacings)?;
            for &particles in &self.particles {
                for &spacing in &series.spacings {
                    let mut method = self.method.clone();
                    method.options.spacing = Some(spacing);
                    options_fit("method", &method)?;
                    cases.extend(self.seeds.iter().map(|&seed| Case {
                        dim: series.dim,
                        particles: particles.get(),
                        series: method.label().to_owned(),
                        method: method.clone(),
                        spacing_factor: None,
                        seed,
                    }));
                }
            }
        }
        distinct("seeds, particles or series", &cases)?;
        Ok(cases)
    }
}
