//! Study `spacing-particles`: the energy distance from N(0, I) against the spacing h and the number of particles M together.
//!
//! At a fixed spacing the error falls with M until the grid, not the particles, limits it; at fixed M it has a best spacing.

mod report;

use super::gaussian_runs::{GaussianStudy, Setting};
use super::prelude::*;

/// All pairs of a spacing and a number of particles, one series of spacings per dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SpacingParticles {
    /// One run per seed.
    seeds: Vec<u64>,
    /// M.
    particles: Vec<ParticleCount>,
    /// The sampler; its spacing comes from the series.
    method: MethodSpecification,
    /// One per dimension.
    series: Vec<Series>,
}

/// The spacings of one dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Series {
    /// d.
    dim: Dimension,
    /// Spacings h in standard deviations.
    spacings: Vec<f64>,
}

impl Series {
    /// The spacings, fine ones first.
    fn sorted(&self) -> Vec<f64> {
        let mut spacings = self.spacings.clone();
        spacings.sort_by(f64::total_cmp);
        spacings
    }
}

impl GaussianStudy for SpacingParticles {
    const KIND: &'static str = "spacing-particles";
    const REPORT: Report<Self> = report::report;

    /// The cases, dimension by dimension.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        all_given!(self: seeds, particles, series);
        unset("method.options.spacing", &self.method.options.spacing, "series")?;
        let mut cases = Vec::new();
        for series in &self.series {
            not_empty("series.spacings", &series.spacings)?;
            positive("series.spacings", &series.spacings)?;
            for &particles in &self.particles {
                for &spacing in &series.spacings {
                    let mut method = self.method.clone();
                    method.options.spacing = Some(spacing);
                    fitting("method", &method)?;
                    cases.extend(Setting::new(series.dim, particles, &method).cases(&self.seeds)?);
                }
            }
        }
        distinct("seeds, particles or series", cases)
    }
}
