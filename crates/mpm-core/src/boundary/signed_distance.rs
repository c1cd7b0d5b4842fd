/// The surface of a rigid body.
pub trait SignedDistance<const D: usize>: Send + Sync {
    /// Distance to the surface, negative inside the body.
    fn distance(&self, x: &[f64; D]) -> f64;

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

impl<const D: usize> SignedDistance<D> for HalfSpace<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        (0..D).map(|a| (x[a] - self.point[a]) * self.normal[a]).sum()
    }

    fn normal(&self, _: &[f64; D]) -> [f64; D] {
        self.normal
    }
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere<const D: usize> {
    /// Its centre.
    pub centre: [f64; D],
    /// Its radius.
    pub radius: f64,
}

impl<const D: usize> Sphere<D> {
    fn offset_of(&self, x: &[f64; D]) -> ([f64; D], f64) {
        let offset: [f64; D] = std::array::from_fn(|a| x[a] - self.centre[a]);
        let length = offset.iter().map(|c| c * c).sum::<f64>().sqrt();
        (offset, length)
    }
}

impl<const D: usize> SignedDistance<D> for Sphere<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        self.offset_of(x).1 - self.radius
    }

    /// At the centre itself, where there is none, the last axis.
    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        let (offset, length) = self.offset_of(x);
        if length > 0.0 {
            offset.map(|c| c / length)
        } else {
            std::array::from_fn(|a| f64::from(u8::from(a + 1 == D)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_the_gradients_of_the_distances() {
        let half_space = HalfSpace {
            point: [0.2, 0.1],
            normal: [0.6, 0.8],
        };
        let sphere = Sphere {
            centre: [-0.3, 0.4],
            radius: 0.5,
        };
        let shapes: [&dyn SignedDistance<2>; 2] = [&half_space, &sphere];
        for shape in shapes {
            for x in [[0.1, 0.2], [1.0, -2.0], [-0.3, 0.6]] {
                let normal = shape.normal(&x);
                for a in 0..2 {
                    let (mut left, mut right) = (x, x);
                    left[a] -= 1e-6;
                    right[a] += 1e-6;
                    let slope = (shape.distance(&right) - shape.distance(&left)) / 2e-6;
                    assert!((normal[a] - slope).abs() < 1e-8);
                }
            }
        }
        assert_eq!(sphere.distance(&[-0.3, 0.4]), -0.5);
        assert_eq!(sphere.normal(&[-0.3, 0.4]), [0.0, 1.0]);
    }
}
