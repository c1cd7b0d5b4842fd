//! Shapes by their signed distance, one per file.

mod ball;
mod bounds;
mod build;
mod capsule;
mod combination;
mod cuboid;
mod facet_grid;
mod half_space;
mod mesh_outside;
mod polygon;
mod rotated;
mod twisted;

pub use ball::Ball;
pub use bounds::Bounds;
pub use build::build;
pub use capsule::Capsule;
pub use combination::{Difference, Intersection, Union};
pub use cuboid::Cuboid;
pub use half_space::HalfSpace;
pub(crate) use mesh_outside::MeshOutside;
pub use polygon::Polygon;
pub(crate) use rotated::Rotated;
pub use twisted::Twisted;

/// A set of points of space, given by the distance to its surface.
pub trait Shape<const D: usize>: std::fmt::Debug + Send + Sync {
    /// Distance to the surface, negative inside. Combinations may give less than the distance, never the wrong sign.
    fn distance(&self, x: &[f64; D]) -> f64;

    /// A box that holds all of the shape; infinite where the shape is.
    fn bounds(&self) -> Bounds<D>;

    /// Volume (length, area), where it is known in closed form.
    fn volume(&self) -> Option<f64> {
        None
    }

    /// The unit vector along which the distance grows, away from the shape: ∇d / |∇d|, by central differences unless a shape knows better. Zero
    /// where there is none, as in the centre of a ball.
    ///
    /// Differences are over a millionth of the largest coordinate, or of the shape's least side where that is shorter, as it is far from the origin.
    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        let far = x.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
        let least = self.bounds().sides().into_iter().fold(f64::INFINITY, f64::min);
        let step = (1e-6 * far.max(1e-3).min(least)).max(64.0 * f64::EPSILON * far);
        unit(std::array::from_fn(|a| {
            let (mut above, mut below) = (*x, *x);
            above[a] += step;
            below[a] -= step;
            self.distance(&above) - self.distance(&below)
        }))
    }

    /// Distance and normal where the distance is less than a limit, or is no number.
    fn closer_than(&self, x: &[f64; D], limit: f64) -> Option<(f64, [f64; D])> {
        let distance = self.distance(x);
        let is_far = distance >= limit;
        (!is_far).then(|| (distance, self.normal(x)))
    }
}

/// v / |v|; zero for the zero vector. Where the square of |v| is no normal number, v is divided by its largest component first.
pub(crate) fn unit<const D: usize>(v: [f64; D]) -> [f64; D] {
    let square = mpm_tensor::vector::dot(&v, &v);
    if square.is_normal() {
        return v.map(|c| c / square.sqrt());
    }
    let largest = v.iter().fold(0.0f64, |largest, c| largest.max(c.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return [0.0; D];
    }
    let scaled = v.map(|c| c / largest);
    let length = mpm_tensor::vector::norm(&scaled);
    scaled.map(|c| c / length)
}

/// Volume of the ball of radius r in n dimensions, n ≤ 3; NaN beyond.
pub(crate) fn ball_volume(dimension: usize, radius: f64) -> f64 {
    use std::f64::consts::PI;
    match dimension {
        0 => 1.0,
        1 => 2.0 * radius,
        2 => PI * radius * radius,
        3 => 4.0 / 3.0 * PI * radius.powi(3),
        _ => f64::NAN,
    }
}
