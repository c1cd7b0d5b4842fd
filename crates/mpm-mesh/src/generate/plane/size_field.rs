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

impl Refinement {
    /// The length at a distance from the centre.
    fn at(&self, distance: f64) -> f64 {
        self.size + self.growth * (distance - self.radius).max(0.0)
    }
}

/// Longest over shortest length in a part of a domain where the middle one stands for all.
const VARIATION: f64 = 1.5;

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
        let near = |place: &Refinement| place.at(distance(x, &place.centre));
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

    /// ∫ dA / h² over a box between its lowest and highest corners: how many squares of the lengths asked for cover it. The box is quartered until h hardly varies in a part, or parts are as
    /// small as the least length.
    pub(super) fn squares_in(&self, bounds: [[f64; 2]; 2]) -> f64 {
        let least = self.least();
        let (mut sum, mut open) = (0.0, vec![bounds]);
        while let Some([lower, upper]) = open.pop() {
            let middle = [0, 1].map(|axis| 0.5 * (lower[axis] + upper[axis]));
            let sides = [0, 1].map(|axis| upper[axis] - lower[axis]);
            let [shortest, longest] = self.range_in(&lower, &upper);
            if longest <= VARIATION * shortest || sides[0].max(sides[1]) <= least {
                sum += sides[0] * sides[1] / self.at(&middle).powi(2);
                continue;
            }
            open.extend([
                [lower, middle],
                [[middle[0], lower[1]], [upper[0], middle[1]]],
                [[lower[0], middle[1]], [middle[0], upper[1]]],
                [middle, upper],
            ]);
        }
        sum
    }

    /// Bounds of h in a box.
    fn range_in(&self, lower: &[f64; 2], upper: &[f64; 2]) -> [f64; 2] {
        let from_centre = |place: &Refinement, far: bool| {
            let arm = [0, 1].map(|axis| {
                let (below, above) = (lower[axis] - place.centre[axis], place.centre[axis] - upper[axis]);
                if far {
                    (-below).max(-above)
                } else {
                    below.max(above).max(0.0)
                }
            });
            place.at(arm[0].hypot(arm[1]))
        };
        [false, true].map(|far| {
            let lengths = self.refinements.iter().map(|place| from_centre(place, far));
            lengths.fold(self.base, f64::min)
        })
    }

    /// ∫ ds / h along the segment from a to b, the number of edges that it takes: sums up to the end of each of `steps` parts of the way, by the midpoint rule.
    pub(super) fn edges_along(&self, a: &[f64; 2], b: &[f64; 2], steps: usize) -> impl Iterator<Item = f64> {
        let length = distance(a, b);
        (0..steps).scan(0.0, move |sum, step| {
            let share = (step as f64 + 0.5) / steps as f64;
            let x = [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
            *sum += length / steps as f64 / self.at(&x);
            Some(*sum)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

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
        let sums: Vec<f64> = field.edges_along(&[9.0, 0.0], &[9.0, 3.0], 8).collect();
        assert!((sums[7] - 10.0).abs() < 1e-12 && (sums[3] - 5.0).abs() < 1e-12);
    }

    #[test]
    fn squares_are_counted_where_lengths_are_short() {
        let plain = SizeField::new(0.1, vec![]).unwrap();
        assert!((plain.squares_in([[0.0; 2], [2.0, 1.0]]) - 200.0).abs() < 1e-9);
        for (radius, size, growth) in [(0.0, 1e-5, 0.2), (0.1, 1e-3, 0.2), (0.1, 1e-3, 1e6), (0.0, 1e-3, 1e6)] {
            let place = Refinement {
                centre: [0.3, 0.6],
                radius,
                size,
                growth,
            };
            let field = SizeField::new(0.1, vec![place]).unwrap();
            // ∫ 2π r dr / h² over the disk in which h < h₀, and the rest of the box.
            let width = (0.1 - size) / growth;
            let part = |s: f64| (s.ln() + size / s) / growth.powi(2) + radius / growth * (-1.0 / s);
            let graded = 2.0 * PI * (part(0.1) - part(size));
            let flat = PI * radius.powi(2) / size.powi(2);
            let rest = (9.0 - PI * (radius + width).powi(2)) / 0.01;
            let (found, expected) = (field.squares_in([[-1.0; 2], [2.0; 2]]), graded + flat + rest);
            assert!(
                (found / expected - 1.0).abs() < 0.05,
                "{radius}, {size}, {growth}: {found}, {expected}"
            );
        }
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
