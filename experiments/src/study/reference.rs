//! What a target is held against that nobody knows in closed form: the importance sample of `parvi-targets`, whatever its dimension.

use parvi::pareto_k;
use parvi_files::Particles;
use parvi_targets::{CatalogueTarget, ImportanceSample, ReferenceOptions};

use super::prelude::*;
use crate::dispatch::on_target;
use crate::statistics::SampleMoments;

/// What is kept of a coordinate: its name, E[x] and √Var[x] with their standard errors.
pub const MOMENTS: &str = "name mean mean_standard_error standard_deviation standard_deviation_standard_error";

/// Quasi-Monte-Carlo importance sampling with a Student t proposal.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Reference {
    /// Points in all.
    pub points: Bounded<1024, 100_000_000>,
    /// Independent scramblings, whose spread gives the standard errors.
    scramblings: Bounded<2, 1024>,
    /// Their seed.
    seed: u64,
    /// Draws resampled from them that are kept for the figures.
    draws: Bounded<100, 1_000_000>,
}

/// What it says of a target. Closed-form moments are not used, so that every target is treated alike.
pub struct Known {
    /// Rows of [`MOMENTS`], one per coordinate.
    pub moments: Vec<Row>,
    /// Draws of equal weight.
    pub draws: Particles,
    /// (Σ w)² / Σ w².
    pub effective_sample_size: f64,
    /// Shape k̂ of the tail of the weights: above 0.7 the spread of the scramblings says little of their error.
    pub pareto_k: Option<f64>,
}

impl Reference {
    /// Draws and weighs.
    ///
    /// # Errors
    /// A target that cannot be sampled so.
    pub fn of(&self, target: &TargetSpecification) -> Result<Known, CommandError> {
        let names = target.coordinate_names();
        on_target!(target, target, D => self.sampled::<D>(target.as_ref(), names))
    }

    fn sampled<const D: usize>(
        &self,
        target: &dyn CatalogueTarget<D>,
        names: Vec<String>,
    ) -> Result<Known, CommandError> {
        let options = ReferenceOptions {
            points: self.points.get(),
            scramblings: self.scramblings.get(),
            seed: self.seed,
            ..ReferenceOptions::default()
        };
        let sample = ImportanceSample::new(target, &options)?;
        let known = sample.moments();
        let (moments, deviation_errors) = (&known.moments, known.standard_deviation_error);
        let axis = |(axis, name): (usize, String)| {
            Row::default()
                .with("name", name)
                .with("mean", moments.mean[axis])
                .with("mean_standard_error", known.mean_error[axis])
                .with("standard_deviation", moments.covariance.0[axis][axis].sqrt())
                .with("standard_deviation_standard_error", deviation_errors[axis])
        };
        let draws = sample.draws().resampled(self.draws.get(), self.seed);
        Ok(Known {
            moments: names.into_iter().take(D).enumerate().map(axis).collect(),
            draws: Particles::new(&draws, None),
            effective_sample_size: known.effective_sample_size,
            pareto_k: pareto_k(&sample.draws().weights),
        })
    }
}

/// Rows of [`MOMENTS`] with the particles' `own_mean` and `own_deviation` and what follows from both: `mean_error` = (x̄ − E\[x\])/sd and, of the standard deviation,
/// the relative `deviation_error` and `deviation_percent`; and the standard errors of the reference's mean and standard deviation in its standard deviations, `reference_error` and
/// `reference_deviation_error`.
pub fn compared(particles: &Particles, reference: Vec<Row>) -> Result<Vec<Row>, CommandError> {
    let moments = SampleMoments::of(&particles.to_rows(), particles.weights())?;
    let own = moments.mean.iter().copied().zip(moments.standard_deviations());
    let axis = |(row, (mean, deviation)): (Row, (f64, f64))| {
        let [known, error, spread, spread_error] = [
            "mean",
            "mean_standard_error",
            "standard_deviation",
            "standard_deviation_standard_error",
        ]
        .map(|column| row.number(column).unwrap_or(f64::NAN));
        let (mean_error, deviation_error) = ((mean - known) / spread, deviation / spread - 1.0);
        row.with("own_mean", mean)
            .with("own_deviation", deviation)
            .with("mean_error", mean_error)
            .with("deviation_error", deviation_error)
            .with("deviation_percent", 100.0 * deviation_error)
            .with("reference_error", error / spread)
            .with("reference_deviation_error", spread_error / spread)
    };
    Ok(reference.into_iter().zip(own).map(axis).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_in_units_of_the_reference() {
        let reference = Row::default().with("mean", 1.0).with("mean_standard_error", 0.002);
        let reference = reference.with("standard_deviation", 2.0);
        let particles = Particles::new(&[[-0.9], [3.1]], None);
        let axes = compared(&particles, vec![reference]).unwrap();
        let number = |column: &str| axes[0].number(column).unwrap();
        assert!((number("mean_error") - 0.05).abs() < 1e-12);
        assert!(number("deviation_error").abs() < 1e-12);
        assert!((number("reference_error") - 0.001).abs() < 1e-12);
    }
}
