//! How far a reduced run is from the full-order one.

use mpm_tensor::vector;

/// The position error of Chen et al. 2023, §5: 100 √(Σ|g − φ|² / Σ|φ|²) in per cent, the sums over all steps, points and test runs, with positions relative to the
/// body's centroid at rest (ours: the paper names no origin).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PositionError {
    /// Σ|g − φ|².
    pub differences: f64,
    /// Σ|φ|².
    pub positions: f64,
}

impl PositionError {
    /// Adds an instant: g_p and φ_p of all points, relative to the centroid at rest. Entries without a partner are ignored.
    pub fn add<const D: usize>(&mut self, reduced: &[[f64; D]], full: &[[f64; D]]) {
        for (g, phi) in reduced.iter().zip(full) {
            self.differences += vector::distance_squared(g, phi);
            self.positions += vector::norm_squared(phi);
        }
    }

    /// Adds what another one has summed.
    pub fn merge(&mut self, other: &Self) {
        self.differences += other.differences;
        self.positions += other.positions;
    }

    /// In per cent; `None` where nothing has been added but zeros.
    pub fn percent(&self) -> Option<f64> {
        (self.positions > 0.0).then(|| 100.0 * (self.differences / self.positions).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_of_every_length_is_ten_per_cent() {
        let mut error = PositionError::default();
        assert_eq!(error.percent(), None);
        error.add(&[[1.1, 0.0], [0.0, 2.2]], &[[1.0, 0.0], [0.0, 2.0]]);
        let mut other = PositionError::default();
        other.add(&[[-3.3, 0.0]], &[[-3.0, 0.0]]);
        error.merge(&other);
        assert!((error.percent().expect("added") - 10.0).abs() < 1e-12);
    }
}
