//! Bends and waves: one coordinate is moved by a function of another.

use super::distinct_axes;
use crate::error::{finite, positive};
use crate::{Bijection, TargetError};

/// The function f of a [`Shear`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// f(y) = 2 b k² (√(1 + (y/k)²) − 1): the parabola b y² within the knee k, straight arms of slope ±2 b k beyond it, so
    /// that nothing grows faster than y.
    Bend {
        /// b, the inverse of a length.
        curvature: f64,
        /// k, a length.
        knee: f64,
    },
    /// f(y) = a sin(ω y + φ).
    Wave {
        /// a, a length.
        amplitude: f64,
        /// ω, radians per length.
        frequency: f64,
        /// φ in radians.
        phase: f64,
    },
}

impl Profile {
    /// f(y).
    fn value(self, y: f64) -> f64 {
        match self {
            Self::Bend { curvature, knee } => {
                let z = y / knee;
                // √(1 + z²) − 1 without cancellation and without overflow.
                let rise = z.abs() * (z.abs() / (1.0 + 1.0_f64.hypot(z)));
                2.0 * curvature * knee * knee * rise
            }
            Self::Wave {
                amplitude,
                frequency,
                phase,
            } => amplitude * (frequency * y + phase).sin(),
        }
    }

    /// f′(y).
    fn slope(self, y: f64) -> f64 {
        match self {
            Self::Bend { curvature, knee } => 2.0 * curvature * (y / 1.0_f64.hypot(y / knee)),
            Self::Wave {
                amplitude,
                frequency,
                phase,
            } => amplitude * frequency * (frequency * y + phase).cos(),
        }
    }
}

/// x_k = y_k + f(y_j), all other coordinates as they are. Keeps volumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    source: usize,
    moved: usize,
    profile: Profile,
}

impl Shear {
    /// The map of ℝᴰ with j = `source`, k = `moved`.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] unless j and k are different axes below D and the knee is above 0;
    /// [`TargetError::NotFinite`] for a number of the profile.
    pub fn new<const D: usize>(source: usize, moved: usize, profile: Profile) -> Result<Self, TargetError> {
        distinct_axes::<D>(&[source, moved])?;
        match profile {
            Profile::Bend { curvature, knee } => {
                finite("the curvature of a bend", curvature)?;
                positive("the knee of a bend", knee)?;
            }
            Profile::Wave {
                amplitude,
                frequency,
                phase,
            } => {
                for value in [amplitude, frequency, phase] {
                    finite("a number of a wave", value)?;
                }
            }
        }
        Ok(Self { source, moved, profile })
    }
}

impl<const D: usize> Bijection<D> for Shear {
    fn forward(&self, y: &[f64; D]) -> [f64; D] {
        let mut x = *y;
        x[self.moved] += self.profile.value(y[self.source]);
        x
    }

    fn inverse(&self, x: &[f64; D]) -> [f64; D] {
        let mut y = *x;
        y[self.moved] -= self.profile.value(x[self.source]);
        y
    }

    fn push_gradient(&self, y: &[f64; D], gradient: &[f64; D]) -> [f64; D] {
        let mut pushed = *gradient;
        pushed[self.source] -= self.profile.slope(y[self.source]) * gradient[self.moved];
        pushed
    }
}
