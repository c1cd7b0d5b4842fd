//! Spirals and helices: a plane is turned by an angle that depends on the place.

use super::distinct_axes;
use crate::error::finite;
use crate::{Bijection, TargetError};

/// What the angle grows with.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Source {
    /// ρ = √(1 + r²), r the distance from the origin in the plane, which the turn keeps.
    Radius,
    /// Another coordinate.
    Axis(usize),
}

/// (x_i, x_j) = R(θ) (y_i, y_j) with the rotation R by θ = a √(1 + y_i² + y_j²) (a spiral) or θ = a y_m (a helix), all other
/// coordinates as they are; a in radians per length. Keeps volumes.
///
/// With P the quarter turn and ∇θ the gradient in x, J⁻ᵀ g = R g − (g · P y) ∇θ, because y = R(−θ(x)) x and dR(−θ)/dθ = −P R(−θ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    plane: [usize; 2],
    source: Source,
    rate: f64,
}

impl Twist {
    /// The spiral in the plane of the axes (i, j) with a = `rate`.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] unless the axes are different and below D; [`TargetError::NotFinite`] for a.
    pub fn by_radius<const D: usize>(plane: [usize; 2], rate: f64) -> Result<Self, TargetError> {
        distinct_axes::<D>(&plane)?;
        Self::checked(plane, Source::Radius, rate)
    }

    /// The helix about the axis m.
    ///
    /// # Errors
    /// As [`by_radius`](Self::by_radius), for three axes.
    pub fn by_axis<const D: usize>(plane: [usize; 2], axis: usize, rate: f64) -> Result<Self, TargetError> {
        distinct_axes::<D>(&[plane[0], plane[1], axis])?;
        Self::checked(plane, Source::Axis(axis), rate)
    }

    fn checked(plane: [usize; 2], source: Source, rate: f64) -> Result<Self, TargetError> {
        let rate = finite("the rate of a twist", rate)?;
        Ok(Self { plane, source, rate })
    }

    /// θ at a point, before or after the turn.
    fn angle(&self, x: &[f64]) -> f64 {
        self.rate
            * match self.source {
                Source::Radius => self.stretched_radius(x),
                Source::Axis(axis) => x[axis],
            }
    }

    fn stretched_radius(&self, x: &[f64]) -> f64 {
        let [i, j] = self.plane;
        1.0_f64.hypot(x[i].hypot(x[j]))
    }

    fn turned<const D: usize>(&self, x: &[f64; D], angle: f64) -> [f64; D] {
        let ([i, j], (sine, cosine)) = (self.plane, angle.sin_cos());
        let mut turned = *x;
        turned[i] = cosine * x[i] - sine * x[j];
        turned[j] = sine * x[i] + cosine * x[j];
        turned
    }
}

impl<const D: usize> Bijection<D> for Twist {
    fn forward(&self, y: &[f64; D]) -> [f64; D] {
        self.turned(y, self.angle(y))
    }

    fn inverse(&self, x: &[f64; D]) -> [f64; D] {
        self.turned(x, -self.angle(x))
    }

    fn push_gradient(&self, y: &[f64; D], gradient: &[f64; D]) -> [f64; D] {
        let [i, j] = self.plane;
        let x = self.forward(y);
        let along = gradient[j] * y[i] - gradient[i] * y[j];
        let mut pushed = self.turned(gradient, self.angle(y));
        match self.source {
            Source::Radius => {
                let rate = self.rate / self.stretched_radius(y);
                for axis in [i, j] {
                    pushed[axis] -= along * rate * x[axis];
                }
            }
            Source::Axis(axis) => pushed[axis] -= along * self.rate,
        }
        pushed
    }
}
