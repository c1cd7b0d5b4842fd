//! The posterior's moments beside the reference's.

use crate::output::Particles;
use crate::plots::results::Row;
use crate::statistics::SampleMoments;

/// The reference's row of each coordinate with the particles' `own_mean` and `own_deviation`; `mean_error` = (x̄ − E\[x\])/sd and, of the standard deviation, the relative
/// `deviation_error` and `deviation_percent`; and the standard error of the reference's mean in its standard deviations, `reference_error`.
pub fn compared(particles: &Particles, reference: Vec<Row>) -> Vec<Row> {
    let moments = SampleMoments::of(&particles.to_rows(), particles.weights());
    let own = moments.mean.iter().copied().zip(moments.standard_deviations());
    let axis = |(row, (mean, deviation)): (Row, (f64, f64))| {
        let [known, error, spread] =
            ["mean", "mean_standard_error", "standard_deviation"].map(|column| row.number(column).unwrap_or(f64::NAN));
        let (mean_error, deviation_error) = ((mean - known) / spread, deviation / spread - 1.0);
        row.with("own_mean", mean)
            .with("own_deviation", deviation)
            .with("mean_error", mean_error)
            .with("deviation_error", deviation_error)
            .with("deviation_percent", 100.0 * deviation_error)
            .with("reference_error", error / spread)
    };
    reference.into_iter().zip(own).map(axis).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_in_units_of_the_reference() {
        let reference = Row::default().with("mean", 1.0).with("mean_standard_error", 0.002);
        let reference = reference.with("standard_deviation", 2.0);
        let particles = Particles::new(&[[-0.9], [3.1]], None);
        let axes = compared(&particles, vec![reference]);
        let number = |column: &str| axes[0].number(column).unwrap();
        assert!((number("mean_error") - 0.05).abs() < 1e-12);
        assert!(number("deviation_error").abs() < 1e-12);
        assert!((number("reference_error") - 0.001).abs() < 1e-12);
    }
}
