use mpm_tensor::vector;

use super::{Bounds, Shape};

/// All points between two corners: an interval, a rectangle, a cuboid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid<const D: usize> {
    /// Lowest corner.
    pub lower: [f64; D],
    /// Highest corner.
    pub upper: [f64; D],
}

impl<const D: usize> Shape<D> for Cuboid<D> {
    /// With q_a = |x_a − centre_a| − half width: |max(q, 0)| outside, the largest q_a inside.
    fn distance(&self, x: &[f64; D]) -> f64 {
        let q: [f64; D] = std::array::from_fn(|a| (self.lower[a] - x[a]).max(x[a] - self.upper[a]));
        let outside = vector::norm(&q.map(|c| c.max(0.0)));
        let inside = q.iter().fold(f64::NEG_INFINITY, |largest, &c| largest.max(c)).min(0.0);
        outside + inside
    }

    fn bounds(&self) -> Bounds<D> {
        Bounds {
            lower: self.lower,
            upper: self.upper,
        }
    }

    fn volume(&self) -> Option<f64> {
        Some((0..D).map(|a| self.upper[a] - self.lower[a]).product())
    }
}
