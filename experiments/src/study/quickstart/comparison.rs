//! The posterior's moments beside the reference's.

use super::Bounds;
use super::reference::ReferenceAxis;
use crate::output::Particles;
use crate::statistics::SampleMoments;

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

/// All coordinates, and the largest errors among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// One entry per coordinate.
    pub axes: Vec<AxisComparison>,
    /// Of a mean in posterior standard deviations.
    pub mean_error: f64,
    /// Of a standard deviation, relative.
    pub deviation_error: f64,
    /// The standard error of a reference mean in posterior standard deviations.
    pub reference_error: f64,
}

impl Comparison {
    /// Compares particles with a reference of the same dimension.
    pub fn new(particles: &Particles, reference: Vec<ReferenceAxis>) -> Self {
        let points = particles.to_rows();
        let moments = SampleMoments::of(&points, particles.weights());
        let own = moments.mean.iter().copied().zip(moments.standard_deviations());
        let axis = |(reference, (mean, standard_deviation)): (ReferenceAxis, (f64, f64))| AxisComparison {
            mean,
            standard_deviation,
            mean_error: (mean - reference.mean) / reference.standard_deviation,
            deviation_error: standard_deviation / reference.standard_deviation - 1.0,
            reference,
        };
        let axes: Vec<AxisComparison> = reference.into_iter().zip(own).map(axis).collect();
        let largest = |error: fn(&AxisComparison) -> f64| axes.iter().map(error).fold(0.0, f64::max);
        Self {
            mean_error: largest(|axis| axis.mean_error.abs()),
            deviation_error: largest(|axis| axis.deviation_error.abs()),
            reference_error: largest(|axis| axis.reference.mean_standard_error / axis.reference.standard_deviation),
            axes,
        }
    }

    /// Whether means and standard deviations keep their bounds.
    pub fn kept(&self, bounds: &Bounds) -> [bool; 2] {
        let kept = |error: f64, bound: f64| !self.axes.is_empty() && error <= bound;
        [
            kept(self.mean_error, bounds.mean),
            kept(self.deviation_error, bounds.standard_deviation),
        ]
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
        let comparison = Comparison::new(&particles, vec![reference]);
        assert!((comparison.mean_error - 0.05).abs() < 1e-12);
        assert!(comparison.deviation_error < 1e-12);
        assert!((comparison.reference_error - 0.001).abs() < 1e-12);
        let bounds = Bounds {
            mean: 0.02,
            standard_deviation: 0.03,
        };
        assert_eq!(comparison.kept(&bounds), [false, true]);
    }
}
