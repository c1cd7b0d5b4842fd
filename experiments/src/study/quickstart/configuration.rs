//! The configuration of the study `quickstart`.

use serde::Deserialize;

use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, ParticleCount, TargetSpecification};

/// A posterior against its reference, and a two-dimensional target for the eye.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Quickstart {
    #[serde(rename = "kind")]
    _kind: String,
    /// Seed of both runs.
    pub seed: u64,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// Steps between two entries of the trace.
    pub trace_every: Bounded<1, 1_000_000>,
    /// The posterior.
    pub posterior: Part,
    /// Its reference.
    pub reference: ReferencePart,
    /// What the posterior has to keep.
    pub bounds: Bounds,
    /// The target for the eye; d = 2.
    pub picture: Part,
}

/// A target, a method and a size.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Part {
    /// Target.
    pub target: TargetSpecification,
    /// Method.
    pub method: MethodSpecification,
    /// M.
    pub particles: ParticleCount,
}

/// Quasi-Monte-Carlo importance sampling with a Student t proposal.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ReferencePart {
    /// Points in all.
    pub points: Bounded<1024, 100_000_000>,
    /// Independent scramblings, whose spread gives the standard errors.
    pub scramblings: Bounded<2, 1024>,
    /// Their seed.
    pub seed: u64,
    /// Draws resampled from them that are kept for the figures.
    pub draws: Bounded<100, 1_000_000>,
}

/// The largest errors that count as a pass.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Bounds {
    /// Of a mean, in posterior standard deviations.
    pub mean: f64,
    /// Of a standard deviation, relative.
    pub standard_deviation: f64,
}

impl Quickstart {
    /// Checks what belongs together.
    pub fn check(&self) -> Result<(), CommandError> {
        let refuse = |field: &str, message: String| {
            Err(CommandError::ConfigField {
                file: String::new(),
                field: field.to_owned(),
                message,
            })
        };
        let dimension = self.picture.target.dimension()?;
        if dimension != 2 {
            return refuse(
                "picture.target",
                format!("`{}` has d = {dimension}, must be 2", self.picture.target.label()),
            );
        }
        for (field, bound) in [
            ("mean", self.bounds.mean),
            ("standard-deviation", self.bounds.standard_deviation),
        ] {
            if !(bound > 0.0 && bound.is_finite()) {
                return refuse(&format!("bounds.{field}"), format!("{bound} must be a number above 0"));
            }
        }
        Ok(())
    }
}
