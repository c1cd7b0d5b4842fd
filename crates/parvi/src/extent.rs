//! Where particles are and how far they spread, to see whether they still move.

use mpm_tensor::vector;

/// Mean and standard deviation of every coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent<const D: usize> {
    pub mean: [f64; D],
    pub deviation: [f64; D],
}

impl<const D: usize> Extent<D> {
    /// Of equally heavy particles.
    pub fn of(positions: &[[f64; D]]) -> Self {
        Self::of_weighted(positions, None)
    }

    /// Of particles whose weights, equal ones where there are none, have the sum one.
    pub fn of_weighted(positions: &[[f64; D]], weights: Option<&[f64]>) -> Self {
        let equal = 1.0 / positions.len() as f64;
        let shares = (0..positions.len()).map(|p| weights.map_or(equal, |weights| weights[p]));
        let (mut mean, mut square) = ([0.0; D], [0.0; D]);
        for (x, share) in positions.iter().zip(shares.clone()) {
            vector::accumulate(&mut mean, share, x);
        }
        for (x, share) in positions.iter().zip(shares) {
            for a in 0..D {
                square[a] += share * (x[a] - mean[a]).powi(2);
            }
        }
        Self {
            mean,
            deviation: square.map(f64::sqrt),
        }
    }

    /// The largest change of a mean or a standard deviation to `other`, in units of the latter's standard deviations.
    pub fn drift_to(&self, other: &Self) -> f64 {
        let of_axis = |a: usize| {
            let mean = (self.mean[a] - other.mean[a]).abs();
            let deviation = (self.deviation[a] - other.deviation[a]).abs();
            mean.max(deviation) / other.deviation[a]
        };
        (0..D).map(of_axis).fold(0.0, f64::max)
    }

    /// Whether the mean is further than half a unit from 0, or a standard deviation more than twice as large or small as 1.
    pub fn outgrows_the_frame(&self) -> bool {
        vector::norm(&self.mean) > 0.5 || self.deviation.iter().any(|deviation| !(0.5..=2.0).contains(deviation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drift_is_in_standard_deviations() {
        let cloud = [[0.0, 10.0], [2.0, 30.0]];
        let moved = [[0.5, 10.0], [2.5, 30.0]];
        let (before, after) = (Extent::of(&cloud), Extent::of(&moved));
        assert_eq!(before.mean, [1.0, 20.0]);
        assert_eq!(before.deviation, [1.0, 10.0]);
        assert_eq!(before.drift_to(&after), 0.5);
        let weighted = Extent::of_weighted(&cloud, Some(&[0.75, 0.25]));
        assert_eq!((weighted.mean, weighted.deviation[0]), ([0.5, 15.0], 0.75_f64.sqrt()));
        assert!(before.outgrows_the_frame());
        assert!(!Extent::of(&[[-1.0], [1.0]]).outgrows_the_frame());
    }
}
