use mpm_tensor::vector;

use super::{Bounds, Shape, ball_volume, unit};

/// All points within `radius` of `centre`: an interval, a disk, a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball<const D: usize> {
    /// The centre.
    pub centre: [f64; D],
    /// The radius.
    pub radius: f64,
}

impl<const D: usize> Shape<D> for Ball<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        vector::distance(x, &self.centre) - self.radius
    }

    fn bounds(&self) -> Bounds<D> {
        Bounds {
            lower: self.centre.map(|c| c - self.radius),
            upper: self.centre.map(|c| c + self.radius),
        }
    }

    fn volume(&self) -> Option<f64> {
        Some(ball_volume(D, self.radius))
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        unit(vector::subtract(x, &self.centre))
    }
}
