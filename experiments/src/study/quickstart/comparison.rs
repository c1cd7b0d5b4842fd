//! The posterior's moments beside the reference's, and the verdict.

use super::Bounds;
use super::reference::ReferenceAxis;
use crate::output::Particles;
use crate::study::moments::SampleMoments;

/// One coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisComparison {
    /// The reference.
    pub reference: ReferenceAxis,
    /// The particles' mean.
    pub mean: f64,
    /// The particles' standard deviation.
    pub standard_deviation: f64,
    /// (x̄ − E[x]) / sd.
    pub mean_error: f64,
    /// sd of the particles / sd of the reference − 1.
    pub deviation_error: f64,
}

/// All coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// One entry per coordinate.
    pub axes: Vec<AxisComparison>,
}

impl Comparison {
    /// Compares particles with a reference of the same dimension.
    pub fn new(particles: &Particles, reference: &[ReferenceAxis]) -> Self {
        let moments = SampleMoments::of(particles);
        let deviations = moments.standard_deviations();
        let axes = reference
            .iter()
            .zip(moments.mean.iter().zip(&deviations))
            .map(|(reference, (&mean, &standard_deviation))| AxisComparison {
                reference: reference.clone(),
                mean,
                standard_deviation,
                mean_error: (mean - reference.mean) / reference.standard_deviation,
                deviation_error: standard_deviation / reference.standard_deviation - 1.0,
            })
            .collect();
        Self { axes }
    }

    fn largest(&self, error: impl Fn(&AxisComparison) -> f64) -> f64 {
        self.axes.iter().map(error).fold(0.0, f64::max)
    }

    /// The largest error of a mean in posterior standard deviations.
    pub fn largest_mean_error(&self) -> f64 {
        self.largest(|axis| axis.mean_error.abs())
    }

    /// The largest relative error of a standard deviation.
    pub fn largest_deviation_error(&self) -> f64 {
        self.largest(|axis| axis.deviation_error.abs())
    }

    /// The largest standard error of a reference mean in posterior standard deviations.
    pub fn largest_reference_error(&self) -> f64 {
        self.largest(|axis| axis.reference.mean_standard_error / axis.reference.standard_deviation)
    }

    /// Whether all means keep their bound.
    pub fn means_pass(&self, bounds: &Bounds) -> bool {
        !self.axes.is_empty() && self.largest_mean_error() <= bounds.mean
    }

    /// Whether all standard deviations keep their bound.
    pub fn deviations_pass(&self, bounds: &Bounds) -> bool {
        !self.axes.is_empty() && self.largest_deviation_error() <= bounds.standard_deviation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_in_units_of_the_reference() {
        let reference = ReferenceAxis {
            name: "x1".to_owned(),
            mean: 1.0,
            mean_standard_error: 0.002,
            standard_deviation: 2.0,
            standard_deviation_standard_error: 0.001,
        };
        let particles = Particles::new(&[[-0.9], [3.1]], None);
        let comparison = Comparison::new(&particles, &[reference]);
        assert!((comparison.largest_mean_error() - 0.05).abs() < 1e-12);
        assert!(comparison.largest_deviation_error() < 1e-12);
        assert!((comparison.largest_reference_error() - 0.001).abs() < 1e-12);
        let bounds = Bounds {
            mean: 0.02,
            standard_deviation: 0.03,
        };
        assert!(!comparison.means_pass(&bounds));
        assert!(comparison.deviations_pass(&bounds));
    }
}
