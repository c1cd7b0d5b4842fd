//! The posterior's reference moments and draws.

use parvi_targets::{CatalogueTarget, ImportanceSample, ReferenceOptions};
use serde::{Deserialize, Serialize};

use super::ReferencePart;
use crate::CommandError;
use crate::output::Particles;

/// Reference mean and standard deviation of one coordinate with their standard errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceAxis {
    /// The coordinate's name.
    pub name: String,
    /// E[x].
    pub mean: f64,
    /// Standard error of the mean.
    pub mean_standard_error: f64,
    /// √Var[x].
    pub standard_deviation: f64,
    /// Standard error of the standard deviation.
    pub standard_deviation_standard_error: f64,
}

/// What importance sampling gave.
pub struct Reference {
    /// One entry per coordinate.
    pub axes: Vec<ReferenceAxis>,
    /// Resampled draws of equal weight.
    pub draws: Particles,
    /// (Σ w)² / Σ w².
    pub effective_sample_size: f64,
}

impl Reference {
    /// Importance sampling of a target; closed-form moments are not used, so that every target is treated alike.
    pub fn of<const D: usize>(
        target: &dyn CatalogueTarget<D>,
        names: &[String],
        part: &ReferencePart,
    ) -> Result<Self, CommandError> {
        let options = ReferenceOptions {
            points: part.points.get(),
            scramblings: part.scramblings.get(),
            seed: part.seed,
            ..ReferenceOptions::default()
        };
        let sample = ImportanceSample::new(target, &options)?;
        let known = sample.moments();
        let axes = (0..D)
            .map(|axis| ReferenceAxis {
                name: names.get(axis).cloned().unwrap_or_else(|| format!("x{}", axis + 1)),
                mean: known.moments.mean[axis],
                mean_standard_error: known.mean_error[axis],
                standard_deviation: known.moments.covariance.0[axis][axis].sqrt(),
                standard_deviation_standard_error: known.standard_deviation_error[axis],
            })
            .collect();
        let draws = sample.draws().resampled(part.draws.get(), part.seed);
        Ok(Self {
            axes,
            draws: Particles::new(&draws, None),
            effective_sample_size: known.effective_sample_size,
        })
    }
}
