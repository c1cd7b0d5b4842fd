//! The posterior's moments beside the reference's.

use super::Bounds;
use crate::output::Particles;
use crate::plots::results::Row;
use crate::statistics::SampleMoments;

/// All coordinates, and the largest errors among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The reference's row of each coordinate, with the particles' `own_mean` and `own_deviation`, `mean_error` = (x̄ − E[x])/sd and
    /// `deviation_error`, of the standard deviations, relative.
    pub axes: Vec<Row>,
    /// Of a mean in posterior standard deviations.
    pub mean_error: f64,
    /// Of a standard deviation, relative.
    pub deviation_error: f64,
    /// The standard error of a reference mean in posterior standard deviations.
    pub reference_error: f64,
}

impl Comparison {
    /// Compares particles with a reference of the same dimension.
    pub fn new(particles: &Particles, reference: Vec<Row>) -> Self {
        let points = particles.to_rows();
        let moments = SampleMoments::of(&points, particles.weights());
        let own = moments.mean.iter().copied().zip(moments.standard_deviations());
        let number = |row: &Row, column: &str| row.number(column).unwrap_or(f64::NAN);
        let axis = |(row, (mean, deviation)): (Row, (f64, f64))| {
            let [known, spread] = ["mean", "standard_deviation"].map(|column| number(&row, column));
            row.with("own_mean", mean)
                .with("own_deviation", deviation)
                .with("mean_error", (mean - known) / spread)
                .with("deviation_error", deviation / spread - 1.0)
        };
        let axes: Vec<Row> = reference.into_iter().zip(own).map(axis).collect();
        let largest = |error: &dyn Fn(&Row) -> f64| axes.iter().map(error).fold(0.0, f64::max);
        let relative = |row: &Row| number(row, "mean_standard_error") / number(row, "standard_deviation");
        Self {
            mean_error: largest(&|row| number(row, "mean_error").abs()),
            deviation_error: largest(&|row| number(row, "deviation_error").abs()),
            reference_error: largest(&relative),
            axes,
        }
    }

    /// Whether means and standard deviations keep their bounds.
    pub fn kept(&self, bounds: &Bounds) -> [bool; 2] {
        let pairs = [
            (self.mean_error, bounds.mean),
            (self.deviation_error, bounds.standard_deviation),
        ];
        pairs.map(|(error, bound)| !self.axes.is_empty() && error <= bound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_in_units_of_the_reference() {
        let reference = Row::default().with("mean", 1.0).with("mean_standard_error", 0.002);
        let reference = reference.with("standard_deviation", 2.0);
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
