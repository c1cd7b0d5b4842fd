//! A slope of sensitive clay that fails retrogressively: no exact solution, so one mesh is measured against another.

use crate::ValidationRow;

/// Run-outs at one time over meshes: (spacing h, run-out).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshStudy(pub Vec<(f64, f64)>);

impl MeshStudy {
    /// Largest run-out minus the smallest, over that of the finest mesh; NaN without meshes.
    pub fn relative_spread(&self) -> f64 {
        let run_outs = || self.0.iter().map(|&(_, run_out)| run_out);
        let finest = self
            .0
            .iter()
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(f64::NAN, |&(_, run_out)| run_out);
        let largest = run_outs().fold(f64::NEG_INFINITY, f64::max);
        let smallest = run_outs().fold(f64::INFINITY, f64::min);
        (largest - smallest) / finest
    }

    /// Within 5 %.
    pub fn check(&self) -> ValidationRow {
        ValidationRow::at_most(
            "spread of the run-out over meshes / finest",
            self.relative_spread(),
            0.05,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::MeshStudy;

    #[test]
    fn the_spread_is_that_of_the_extremes_over_the_finest() {
        let study = MeshStudy(vec![(0.4, 4.80), (0.2, 4.75), (0.1, 4.77)]);
        assert!((study.relative_spread() - 0.05 / 4.77).abs() < 1e-12);
        assert!(study.check().passes());
        assert!(!MeshStudy::default().check().passes());
    }
}
