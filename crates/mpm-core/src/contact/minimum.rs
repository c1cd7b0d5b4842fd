//! The contact's problem of one node.

use mpm_tensor::{Cholesky, Matrix, vector};

use super::{ContactPoint, ContactPotential};

/// A particle near the node: its point and w_ip.
pub(super) type Share<'a, const D: usize> = (&'a ContactPoint<D>, f64);

/// Part of the way to a surface that one iteration goes at most.
const WAY: f64 = 0.9;

/// How often a direction is halved, and how many directions there are, at most.
const HALVINGS: usize = 30;
const ITERATIONS: usize = 100;

/// Force that is left over, relative to all that are in balance.
const TOLERANCE: f64 = 1e-11;

/// φ(u) = `inertia` |u − free|² / 2 + Σ_p w_p A_p b(g_p + n_p · u).
pub(super) struct NodeProblem<'a, const D: usize> {
    /// m / e^(−γΔt) Δt² > 0.
    pub inertia: f64,
    /// Δt v*.
    pub free: [f64; D],
    pub shares: &'a [Share<'a, D>],
    pub potential: &'a dyn ContactPotential<D>,
}

impl<const D: usize> NodeProblem<'_, D> {
    /// The minimum, by Newton's method with directions shortened where they lead to a surface or to a steeper slope. All iterates are on the right side of every surface.
    pub fn minimum(&self) -> [f64; D] {
        let mut at = vector::scale(&self.free, self.way_along(&[0.0; D], &self.free));
        let mut here = self.derivatives(&at);
        for _ in 0..ITERATIONS {
            if vector::norm(&here.gradient) <= TOLERANCE * here.forces {
                break;
            }
            let Ok(factor) = Cholesky::new(&here.hessian) else {
                break;
            };
            let direction = vector::scale(&factor.solve(&here.gradient), -1.0);
            let slope = vector::dot(&here.gradient, &direction);
            let (start, mut way) = (at, self.way_along(&at, &direction));
            for _ in 0..HALVINGS {
                at = vector::add_scaled(&start, way, &direction);
                here = self.derivatives(&at);
                if vector::dot(&here.gradient, &direction) <= -0.9 * slope {
                    break;
                }
                way *= 0.5;
            }
            if vector::norm(&direction) <= f64::EPSILON * vector::norm(&at) {
                break;
            }
        }
        at
    }

    /// The largest t ≤ 1 with which t `direction` goes at most `WAY` of the way to any surface.
    fn way_along(&self, from: &[f64; D], direction: &[f64; D]) -> f64 {
        let ways = self
            .shares
            .iter()
            .filter(|(_, weight)| *weight > 0.0)
            .map(|(point, _)| {
                let approach = -vector::dot(&point.normal, direction);
                let left = WAY * gap(point, from);
                if approach > left { left / approach } else { 1.0 }
            });
        ways.fold(1.0, f64::min)
    }

    /// φ around a displacement.
    fn derivatives(&self, at: &[f64; D]) -> Derivatives<D> {
        let pull = vector::scale(&vector::subtract(at, &self.free), self.inertia);
        let mut sum = Derivatives {
            gradient: pull,
            hessian: Matrix::IDENTITY * self.inertia,
            forces: vector::norm(&pull),
        };
        for (point, weight) in self.shares {
            // A negative weight has the tangent of b in its place, which keeps φ convex.
            let distance = if *weight > 0.0 { gap(point, at) } else { point.distance };
            let (pressure, stiffness) = self.potential.pressure_and_stiffness(distance);
            let scale = weight * point.area;
            vector::accumulate(&mut sum.gradient, -scale * pressure, &point.normal);
            sum.forces += scale.abs() * pressure;
            if *weight > 0.0 && stiffness > 0.0 {
                for (row, a) in sum.hessian.0.iter_mut().zip(&point.normal) {
                    vector::accumulate(row, scale * stiffness * a, &point.normal);
                }
            }
        }
        sum
    }
}

/// ∇φ, its derivative, and the sum of the sizes of what ∇φ is a sum of.
struct Derivatives<const D: usize> {
    gradient: [f64; D],
    hessian: Matrix<D>,
    forces: f64,
}

/// g_p + n_p · u.
fn gap<const D: usize>(point: &ContactPoint<D>, displacement: &[f64; D]) -> f64 {
    point.distance + vector::dot(&point.normal, displacement)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::Sites;

    /// b = −(g − 1)² ln g below 1.
    struct Logarithm;

    impl ContactPotential<2> for Logarithm {
        fn points(&self, _: &Sites<2>, _: f64, _: &mut Vec<ContactPoint<2>>) {}

        fn pressure_and_stiffness(&self, g: f64) -> (f64, f64) {
            if g >= 1.0 {
                return (0.0, 0.0);
            }
            let overlap = g - 1.0;
            let quotient = overlap / g;
            (
                2.0 * overlap * g.ln() + overlap * quotient,
                -2.0 * g.ln() - 4.0 * quotient + quotient * quotient,
            )
        }
    }

    proptest! {
        /// Whatever inertia, speed and distances are, also between two walls: the gradient vanishes beside what it is a sum of, and no surface is reached.
        #[test]
        fn the_minimum_is_found_on_the_right_side_of_all_surfaces(
            distances in proptest::collection::vec((-3.0..0.3f64, -3.0..0.0f64, 0.0..6.3f64), 1..8),
            free in [-30.0..30.0f64, -30.0..30.0],
            inertia in -6..6i32,
        ) {
            let points: Vec<_> = distances.iter().map(|&(distance, area, angle)| ContactPoint {
                particle: 0,
                area: 10f64.powf(area),
                distance: 10f64.powf(distance),
                normal: [angle.cos(), angle.sin()],
            }).collect();
            let shares: Vec<Share<2>> = points.iter().map(|point| (point, 0.25)).collect();
            let problem = NodeProblem { inertia: 10f64.powi(inertia), free, shares: &shares, potential: &Logarithm };
            let at = problem.minimum();
            prop_assert!(points.iter().all(|point| gap(point, &at) > 0.0));
            let there = problem.derivatives(&at);
            let rounding = f64::EPSILON * there.hessian.frobenius_norm() * (2.0 + vector::norm(&at));
            prop_assert!(vector::norm(&there.gradient) <= 1e-10 * there.forces + 4.0 * rounding, "{:?} of {}", there.gradient, there.forces);
        }
    }
}
