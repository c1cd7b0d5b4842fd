use super::{Bounds, Shape};

/// A shape of three dimensions, twisted about the z axis: a point x is inside where the straight shape holds R(−rate z) x, so that the section at height z is turned by rate z.
///
/// Turning back shears by c = |rate| r at the distance r from the axis, and so stretches lengths by at most s(r) = ½ (c + √(c² + 4)). With r that of x or of the
/// straight shape's farthest point, whichever is larger, the straight shape's distance there over s(r) has the right sign and is never more than the distance.
#[derive(Debug)]
pub struct Twisted<const D: usize> {
    shape: Box<dyn Shape<D>>,
    rate: f64,
    /// The distance from the axis of the farthest corner of the straight shape's bounds.
    radius: f64,
}

impl<const D: usize> Twisted<D> {
    /// A straight shape with finite bounds, and the angle per height (rad/m).
    pub fn new(shape: Box<dyn Shape<D>>, rate: f64) -> Self {
        let Bounds { lower, upper } = shape.bounds();
        let farthest = |axis: usize| lower[axis].abs().max(upper[axis].abs());
        let radius = farthest(0).hypot(farthest(1));
        Self { shape, rate, radius }
    }
}

impl<const D: usize> Shape<D> for Twisted<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        let shear = self.rate.abs() * self.radius.max(x[0].hypot(x[1]));
        let stretch = 0.5 * (shear + shear.hypot(2.0));
        let (sine, cosine) = (self.rate * x[2]).sin_cos();
        let mut straight = *x;
        straight[0] = cosine * x[0] + sine * x[1];
        straight[1] = cosine * x[1] - sine * x[0];
        self.shape.distance(&straight) / stretch
    }

    fn bounds(&self) -> Bounds<D> {
        let mut bounds = self.shape.bounds();
        bounds.lower[..2].fill(-self.radius);
        bounds.upper[..2].fill(self.radius);
        bounds
    }

    /// A twist keeps volumes.
    fn volume(&self) -> Option<f64> {
        self.shape.volume()
    }
}
