use mpm_tensor::vector;

use crate::MpmError;
use crate::error::{finite, within};

/// The surface of a rigid body.
pub trait SignedDistance<const D: usize>: Send + Sync {
    /// Distance to the surface, negative inside the body.
    fn distance(&self, x: &[f64; D]) -> f64;

    /// The same of a particle, where surfaces that stand at nodes alone have another for these.
    fn distance_of_particle(&self, x: &[f64; D]) -> f64 {
        self.distance(x)
    }

    /// The mirror image of a node behind the surface, where the mesh may have one.
    fn image(&self, _x: &[f64; D]) -> Option<[f64; D]> {
        None
    }

    /// Whether its parameters are in their ranges.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] with the first that is not.
    fn check(&self) -> Result<(), MpmError> {
        Ok(())
    }

    /// Unit normal, out of the body: the gradient of [`distance`](Self::distance).
    fn normal(&self, x: &[f64; D]) -> [f64; D];
}

/// The half-space below a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace<const D: usize> {
    /// A point of the plane.
    pub point: [f64; D],
    /// Unit normal, out of the half-space.
    pub normal: [f64; D],
}

/// A normal's length is 1.
pub(super) fn check_normal<const D: usize>(normal: &[f64; D]) -> Result<(), MpmError> {
    let length = vector::norm(normal);
    within("normal", length, (length - 1.0).abs() < 1e-9, "a vector of length 1")
}

impl<const D: usize> SignedDistance<D> for HalfSpace<D> {
    fn check(&self) -> Result<(), MpmError> {
        finite("point", &self.point)?;
        check_normal(&self.normal)
    }

    fn distance(&self, x: &[f64; D]) -> f64 {
        (0..D).map(|a| (x[a] - self.point[a]) * self.normal[a]).sum()
    }

    fn normal(&self, _: &[f64; D]) -> [f64; D] {
        self.normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_is_the_gradient_of_the_distance() {
        let half_space = HalfSpace {
            point: [0.2, 0.1],
            normal: [0.6, 0.8],
        };
        for x in [[0.1, 0.2], [1.0, -2.0], [-0.3, 0.6]] {
            let normal = half_space.normal(&x);
            for a in 0..2 {
                let (mut left, mut right) = (x, x);
                left[a] -= 1e-6;
                right[a] += 1e-6;
                let slope = (half_space.distance(&right) - half_space.distance(&left)) / 2e-6;
                assert!((normal[a] - slope).abs() < 1e-8);
            }
        }
    }
}
