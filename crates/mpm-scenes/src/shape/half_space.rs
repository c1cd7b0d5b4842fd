use mpm_tensor::vector;

use super::{Bounds, Shape};

/// All points x with (x − point) · normal ≤ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace<const D: usize> {
    /// A point of the plane.
    pub point: [f64; D],
    /// The unit vector out of the half-space.
    pub normal: [f64; D],
}

impl<const D: usize> Shape<D> for HalfSpace<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        vector::dot(&vector::subtract(x, &self.point), &self.normal)
    }

    /// Finite along an axis that the plane is across.
    fn bounds(&self) -> Bounds<D> {
        let mut bounds = Bounds::EVERYWHERE;
        for a in 0..D {
            if self.normal[a] == 1.0 {
                bounds.upper[a] = self.point[a];
            } else if self.normal[a] == -1.0 {
                bounds.lower[a] = self.point[a];
            }
        }
        bounds
    }

    fn normal(&self, _: &[f64; D]) -> [f64; D] {
        self.normal
    }
}
