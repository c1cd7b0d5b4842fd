use mpm_tensor::vector;

use crate::MpmError;
use crate::error::not_negative;

/// What a rigid surface does to the velocity of the material at it, relative to its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// The material goes with the surface: fixed where the surface rests, prescribed where it moves.
    Stick,
    /// The material neither leaves nor enters, and slides freely: a roller, or a plane of symmetry.
    Slip,
    /// The material may leave and does not enter: where a particle would come nearer than half its size, (V_p)^(1/D) / 2, in a step, its nodes go no farther than that. It slides
    /// against Coulomb friction with coefficient `friction` ≥ 0: the tangential velocity falls by at most `friction` times the normal velocity that the surface takes away.
    Separate {
        /// Coefficient of friction.
        friction: f64,
    },
}

impl Contact {
    /// 0 ≤ friction < ∞.
    pub(super) fn check(&self) -> Result<(), MpmError> {
        match *self {
            Self::Separate { friction } => not_negative("friction", friction),
            Self::Stick | Self::Slip => Ok(()),
        }
    }

    /// As [`resolve`](Self::resolve), where material that can leave is free to come nearer at a speed of `closing` ≥ 0, which may be ∞.
    #[inline]
    pub(super) fn resolve_at<const D: usize>(&self, normal: &[f64; D], velocity: &[f64; D], closing: f64) -> [f64; D] {
        if closing == 0.0 {
            return self.resolve(normal, velocity);
        }
        if closing == f64::INFINITY {
            return *velocity;
        }
        let left = self.resolve(normal, &vector::add_scaled(velocity, closing, normal));
        vector::add_scaled(&left, -closing, normal)
    }

    /// The velocity that is left of `velocity`, both relative to the surface, whose unit normal points at the material.
    #[inline]
    pub fn resolve<const D: usize>(&self, normal: &[f64; D], velocity: &[f64; D]) -> [f64; D] {
        let approach: f64 = (0..D).map(|a| normal[a] * velocity[a]).sum();
        let tangential: [f64; D] = std::array::from_fn(|a| velocity[a] - approach * normal[a]);
        match *self {
            Self::Stick => [0.0; D],
            Self::Slip => tangential,
            Self::Separate { .. } if approach >= 0.0 => *velocity,
            Self::Separate { friction } => {
                let speed = tangential.iter().map(|c| c * c).sum::<f64>().sqrt();
                let lost = -friction * approach;
                if lost >= speed {
                    [0.0; D]
                } else {
                    tangential.map(|c| c * (1.0 - lost / speed))
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contacts_do_what_they_say() {
        let normal = [0.0, 1.0];
        assert_eq!(Contact::Stick.resolve(&normal, &[3.0, 1.0]), [0.0, 0.0]);
        assert_eq!(Contact::Slip.resolve(&normal, &[3.0, 1.0]), [3.0, 0.0]);
        let rough = Contact::Separate { friction: 0.5 };
        assert_eq!(rough.resolve(&normal, &[3.0, 1.0]), [3.0, 1.0], "leaving");
        assert_eq!(rough.resolve(&normal, &[3.0, -2.0]), [2.0, 0.0], "sliding");
        assert_eq!(rough.resolve(&normal, &[3.0, -7.0]), [0.0, 0.0], "sticking");
        assert_eq!(rough.resolve_at(&normal, &[3.0, -2.0], 2.5), [3.0, -2.0], "coming");
        assert_eq!(rough.resolve_at(&normal, &[3.0, -2.0], 1.0), [2.5, -1.0], "touching");
        assert_eq!(
            rough.resolve_at(&normal, &[3.0, -2.0], f64::INFINITY),
            [3.0, -2.0],
            "far"
        );
    }
}
