//! The posterior's reference moments and draws.

use parvi_targets::{CatalogueTarget, ImportanceSample, ReferenceOptions};

use super::ReferencePart;
use crate::CommandError;
use crate::output::Particles;
use crate::plots::results::Row;

/// What is kept of a coordinate: its name, E[x] and √Var[x] with their standard errors.
pub const COLUMNS: &str = "name mean mean_standard_error standard_deviation standard_deviation_standard_error";

/// What importance sampling gave.
pub struct Reference {
    /// A row per coordinate.
    pub axes: Vec<Row>,
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
        let axis = |axis: usize| {
            let name = names.get(axis).cloned().unwrap_or_else(|| format!("x{}", axis + 1));
            Row::default()
                .with("name", name)
                .with("mean", known.moments.mean[axis])
                .with("mean_standard_error", known.mean_error[axis])
                .with("standard_deviation", known.moments.covariance.0[axis][axis].sqrt())
                .with(
                    "standard_deviation_standard_error",
                    known.standard_deviation_error[axis],
                )
        };
        let axes = (0..D).map(axis).collect();
        let draws = sample.draws().resampled(part.draws.get(), part.seed);
        Ok(Self {
            axes,
            draws: Particles::new(&draws, None),
            effective_sample_size: known.effective_sample_size,
        })
    }
}
