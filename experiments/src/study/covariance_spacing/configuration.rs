//! The configuration of the study `covariance-spacing`.

use serde::Deserialize;

use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount};

/// Resting particles at several spacings, one series per dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CovarianceSpacing {
    #[serde(rename = "kind")]
    _kind: String,
    /// Seeds of the start, one case each.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// M.
    pub particles: ParticleCount,
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
    /// A spacing at which the error is judged.
    pub judged_spacing: Option<f64>,
    /// The largest covariance error allowed there.
    pub bound: Option<f64>,
}

impl CovarianceSpacing {
    /// Checks what belongs together.
    pub fn check(&self) -> Result<(), CommandError> {
        let refuse = |field: &str, message: String| {
            Err(CommandError::ConfigField {
                file: String::new(),
                field: field.to_owned(),
                message,
            })
        };
        if self.seeds.is_empty() {
            return refuse("seeds", "is empty".to_owned());
        }
        if self.method.options.spacing.is_some() {
            return refuse(
                "method.options.spacing",
                "belongs into the series' `spacings`".to_owned(),
            );
        }
        for series in &self.series {
            if let Some(spacing) = series.spacings.iter().find(|h| !(**h > 0.0 && h.is_finite())) {
                return refuse("spacings", format!("{spacing} must be a number above 0"));
            }
            if let Some(judged) = series.judged_spacing
                && !series.spacings.contains(&judged)
            {
                return refuse(
                    "judged-spacing",
                    format!("{judged} is not among the spacings of d = {}", series.dim),
                );
            }
        }
        Ok(())
    }
}
