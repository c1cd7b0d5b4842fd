/// What a rigid surface does to the velocity of the material at it, relative to its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// The material goes with the surface: fixed where the surface rests, prescribed where it moves.
    Stick,
    /// The material neither leaves nor enters, and slides freely: a roller, or a plane of symmetry.
    Slip,
    /// The material may leave, does not enter, and slides against Coulomb friction with coefficient `friction` ≥ 0: the tangential
    /// velocity falls by at most `friction` times the normal velocity that the surface takes away.
    Separate {
        /// Coefficient of friction.
        friction: f64,
    },
}

impl Contact {
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
    }
}
