use mpm_tensor::vector;

use super::{Bounds, Shape, ball_volume, unit};

/// All points within `radius` of the segment from `start` to `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule<const D: usize> {
    /// One end of the segment.
    pub start: [f64; D],
    /// The other end.
    pub end: [f64; D],
    /// The radius.
    pub radius: f64,
}

impl<const D: usize> Capsule<D> {
    /// From the nearest point of the segment to x.
    fn offset(&self, x: &[f64; D]) -> [f64; D] {
        let along = vector::subtract(&self.end, &self.start);
        let from_start = vector::subtract(x, &self.start);
        let share = vector::dot(&from_start, &along) / vector::norm_squared(&along).max(f64::MIN_POSITIVE);
        vector::add_scaled(&from_start, -share.clamp(0.0, 1.0), &along)
    }
}

impl<const D: usize> Shape<D> for Capsule<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        vector::norm(&self.offset(x)) - self.radius
    }

    fn bounds(&self) -> Bounds<D> {
        let at = |centre: [f64; D]| Bounds {
            lower: centre.map(|c| c - self.radius),
            upper: centre.map(|c| c + self.radius),
        };
        at(self.start).hull(&at(self.end))
    }

    fn volume(&self) -> Option<f64> {
        let length = vector::distance(&self.start, &self.end);
        Some(ball_volume(D, self.radius) + length * ball_volume(D - 1, self.radius))
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        unit(self.offset(x))
    }
}
