//! How long edges should be at every point.

use mpm_tensor::vector::distance;

use crate::generate::GenerationError;

/// A place around which edges are shorter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// Its centre.
    pub centre: [f64; 2],
    /// Up to this distance from the centre edges have the length `size`.
    pub radius: f64,
    /// The length there.
    pub size: f64,
    /// By how much edges get longer per length of the way outwards; 0.2 to 0.3 keeps triangles near to equilateral.
    pub growth: f64,
}

/// h(x) = min(h₀, min_k (h_k + g_k max(0, |x − c_k| − r_k))): a length h₀ with refinements.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeField {
    base: f64,
    refinements: Vec<Refinement>,
}

impl SizeField {
    /// Of a length h₀ and refinements.
    ///
    /// # Errors
    /// [`GenerationError::InvalidParameter`] unless lengths and growths are positive and radii not negative, all finite.
    pub fn new(base: f64, refinements: Vec<Refinement>) -> Result<Self, GenerationError> {
        GenerationError::check_positive("length", base)?;
        for refinement in &refinements {
            GenerationError::check_positive("size of a refinement", refinement.size)?;
            GenerationError::check_positive("growth of a refinement", refinement.growth)?;
            let Refinement { centre, radius, .. } = *refinement;
            if radius < 0.0 || !radius.is_finite() {
                return Err(GenerationError::InvalidParameter {
                    name: "radius of a refinement",
                    value: radius,
                    requirement: "at least 0 and finite",
                });
            }
            if let Some(&value) = centre.iter().find(|c| !c.is_finite()) {
                return Err(GenerationError::InvalidParameter {
                    name: "centre of a refinement",
                    value,
                    requirement: "finite",
                });
            }
        }
        Ok(Self { base, refinements })
    }

    /// h(x).
    pub fn at(&self, x: &[f64; 2]) -> f64 {
        let near =
            |place: &Refinement| place.size + place.growth * (distance(x, &place.centre) - place.radius).max(0.0);
        self.refinements.iter().map(near).fold(self.base, f64::min)
    }

    /// The longest length anywhere, h₀.
    pub fn base(&self) -> f64 {
        self.base
    }

    /// The least length anywhere.
    pub fn least(&self) -> f64 {
        self.refinements
            .iter()
            .map(|place| place.size)
            .fold(self.base, f64::min)
    }

    /// ∫ ds / h along the segment from a to b, the number of edges that it takes: sums up to `steps` parts of the way, by the midpoint rule.
    pub(super) fn edges_along(&self, a: &[f64; 2], b: &[f64; 2], steps: usize) -> Vec<f64> {
        let length = distance(a, b);
        let mut sums = vec![0.0; steps + 1];
        for k in 0..steps {
            let share = (k as f64 + 0.5) / steps as f64;
            let x = [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
            sums[k + 1] = sums[k] + length / steps as f64 / self.at(&x);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_of_all_places_counts() {
        let place = Refinement {
            centre: [1.0, 0.0],
            radius: 0.5,
            size: 0.1,
            growth: 0.2,
        };
        let field = SizeField::new(0.3, vec![place]).unwrap();
        for (x, expected) in [([1.2, 0.0], 0.1), ([2.0, 0.0], 0.2), ([9.0, 0.0], 0.3)] {
            assert!((field.at(&x) - expected).abs() < 1e-15, "{x:?}");
        }
        assert_eq!(field.least(), 0.1);
        let sums = field.edges_along(&[9.0, 0.0], &[9.0, 3.0], 8);
        assert!((sums[8] - 10.0).abs() < 1e-12 && (sums[4] - 5.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_length_is_refused() {
        let place = Refinement {
            centre: [0.0; 2],
            radius: 0.0,
            size: 0.1,
            growth: 0.2,
        };
        for bad in [
            Refinement { size: 0.0, ..place },
            Refinement { growth: -0.1, ..place },
            Refinement { radius: -1.0, ..place },
            Refinement {
                centre: [f64::NAN, 0.0],
                ..place
            },
        ] {
            assert!(SizeField::new(1.0, vec![bad]).is_err(), "{bad:?}");
        }
        assert!(SizeField::new(-1.0, vec![]).is_err());
    }
}
