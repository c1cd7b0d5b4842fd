use mpm_tensor::vector;

use crate::shape::Shape;

/// Contact of particles with rigid shapes by the energy b(g) = −k (g − ĝ)² ln(g / ĝ) per area at distances 0 < g < ĝ; b = 0 beyond,
/// and without bound towards g = 0.
///
/// A particle has the contact area A_p = (V⁰_p)^{(D−1)/D} (1 for D = 1), so that a force per area does not depend on how finely a body is filled. The normal force is
/// A_p p n with the pressure p = −b'(g) = k [2 (g − ĝ) ln(g/ĝ) + (g − ĝ)²/g]; friction is that of [`mpm_core::Friction`].
///
/// Source: Li et al., *Incremental potential contact*, ACM Trans. Graph. 39 (2020), Eq. 6; Li, Fang, Li & Jiang, *BFEMP*, Comput. Methods Appl.
/// Mech. Engrg. 390 (2022) 114350.
#[derive(Debug)]
pub struct Barrier<const D: usize> {
    /// The rigid shapes.
    pub shapes: Vec<Box<dyn Shape<D>>>,
    /// k > 0.
    pub stiffness: f64,
    /// ĝ > 0.
    pub gap: f64,
    /// μ ≥ 0.
    pub friction: f64,
    /// ε ≥ 0, the sliding speed from which friction is full.
    pub friction_speed: f64,
    /// No particle goes farther than this in a step, whatever the barrier says.
    pub reach: f64,
    /// Whether a step takes it at the nodes, by the distances at its end ([`mpm_core::ContactPotential`]), or as a force at the particles, by those at its start.
    pub implicit: bool,
}

/// A particle that has reached or passed the surface of a rigid shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// Its place among the particles.
    pub index: usize,
    /// Its distance to the surface, ≤ 0.
    pub distance: f64,
}

impl<const D: usize> Barrier<D> {
    /// b(g), an energy per area.
    pub fn energy(&self, g: f64) -> f64 {
        if g >= self.gap {
            return 0.0;
        }
        if g <= 0.0 {
            return f64::INFINITY;
        }
        -self.stiffness * (g - self.gap).powi(2) * (g / self.gap).ln()
    }

    /// p = −b'(g).
    pub fn pressure(&self, g: f64) -> f64 {
        if g >= self.gap {
            return 0.0;
        }
        let overlap = g - self.gap;
        self.stiffness * (2.0 * overlap * (g / self.gap).ln() + overlap * overlap / g)
    }

    /// b''(g) = k [−2 ln(g/ĝ) − 4 (g − ĝ)/g + (g − ĝ)²/g²], the stiffness of the contact per area.
    pub fn second_derivative(&self, g: f64) -> f64 {
        if g >= self.gap {
            return 0.0;
        }
        let overlap = (g - self.gap) / g;
        self.stiffness * (-2.0 * (g / self.gap).ln() - 4.0 * overlap + overlap * overlap)
    }

    /// Σ_k b(g_k) over the shapes, per area.
    pub fn energy_at(&self, x: &[f64; D]) -> f64 {
        self.shapes.iter().map(|shape| self.energy(shape.distance(x))).sum()
    }

    /// Normal force per area on a particle.
    pub fn traction(&self, x: &[f64; D]) -> [f64; D] {
        let mut sum = [0.0; D];
        for shape in &self.shapes {
            if let Some((g, normal)) = shape.closer_than(x, self.gap) {
                vector::accumulate(&mut sum, self.pressure(g), &normal);
            }
        }
        sum
    }

    /// The longest time step for one particle of mass m and contact area A, where the force is that at the start of the step.
    ///
    /// A particle in the gap has the energy E = ½ m v_n² + A b(g) and comes as close as g_t, A b(g_t) = E. Its step is a quarter of √(m / (A b''(g_t))), the time of the
    /// contact's spring there. E and so the step stay the same from touch to release: with the spring's time at the
    /// present g the step would grow and shrink, and symplectic Euler hand the particle a tenth of its energy. A particle on its way may enter the gap by one
    /// such step, and none goes more than half the way to the surface. Friction asks for nothing.
    ///
    /// # Errors
    /// The distance to a surface that the particle has reached.
    pub fn longest_step(&self, x: &[f64; D], velocity: &[f64; D], mass: f64, area: f64) -> Result<f64, f64> {
        let mut longest = f64::INFINITY;
        for shape in &self.shapes {
            let Some((g, normal)) = shape.closer_than(x, self.gap + self.reach) else {
                continue;
            };
            if g.is_nan() || g <= 0.0 {
                return Err(g);
            }
            let approach = -vector::dot(velocity, &normal);
            longest = longest.min(self.step_from(g, approach, mass, area));
        }
        Ok(longest)
    }

    /// The longest step from the distance g at the speed `approach` towards the surface.
    fn step_from(&self, g: f64, approach: f64, mass: f64, area: f64) -> f64 {
        if g >= self.gap && approach <= 0.0 {
            return f64::INFINITY;
        }
        let nearest = self.turning_point(0.5 * mass * approach * approach / area + self.energy(g));
        let contact = 0.25 * (mass / (area * self.second_derivative(nearest))).sqrt();
        let before = if g > self.gap { (g - self.gap) / approach } else { 0.0 };
        let half_way = if approach > 0.0 {
            0.5 * g / approach
        } else {
            f64::INFINITY
        };
        (before + contact).min(half_way)
    }

    /// g_t in (0, ĝ] with b(g_t) = `energy`, by bisection of its logarithm; at most the true one.
    fn turning_point(&self, energy: f64) -> f64 {
        // e⁻⁷⁰⁰ is about the least power of e that is a normal number.
        let (mut low, mut high) = (-700.0, 0.0);
        for _ in 0..BISECTIONS {
            let middle: f64 = 0.5 * (low + high);
            if self.energy(self.gap * middle.exp()) > energy {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.gap * low.exp()
    }
}

/// They leave 700 / 2⁴⁰ of a logarithm, less than 10⁻⁹.
const BISECTIONS: u32 = 40;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::HalfSpace;

    fn floor() -> Barrier<2> {
        Barrier {
            shapes: vec![Box::new(HalfSpace {
                point: [0.0, 0.0],
                normal: [0.0, 1.0],
            })],
            stiffness: 3.0,
            gap: 0.1,
            friction: 0.0,
            friction_speed: 0.0,
            reach: 10.0,
            implicit: false,
        }
    }

    #[test]
    fn pressure_and_stiffness_are_the_derivatives_of_the_energy() {
        let barrier = floor();
        for g in [1e-3, 0.01, 0.05, 0.0999] {
            let step = 1e-5 * g;
            let slope = (barrier.energy(g + step) - barrier.energy(g - step)) / (2.0 * step);
            assert!(
                (barrier.pressure(g) + slope).abs() < 1e-7 * barrier.pressure(g).max(1e-3),
                "{g}"
            );
            let slope = (barrier.pressure(g + step) - barrier.pressure(g - step)) / (2.0 * step);
            assert!(
                (barrier.second_derivative(g) + slope).abs() < 1e-6 * barrier.second_derivative(g),
                "{g}"
            );
        }
        assert_eq!(
            (
                barrier.energy(0.1),
                barrier.pressure(0.1),
                barrier.second_derivative(0.2)
            ),
            (0.0, 0.0, 0.0)
        );
        assert_eq!(barrier.energy(0.0), f64::INFINITY);
    }

    #[test]
    fn the_traction_is_the_pressure_along_the_normal() {
        let barrier = floor();
        assert_eq!(barrier.traction(&[2.0, 0.03]), [0.0, barrier.pressure(0.03)]);
        assert_eq!(barrier.traction(&[0.0, 0.2]), [0.0, 0.0]);
    }

    /// One particle that falls on the floor, by symplectic Euler with the steps that the barrier allows, leaves as it came: E from a millionth to three
    /// times k A ĝ².
    #[test]
    fn a_bounce_keeps_the_energy() {
        let (barrier, mass, area) = (floor(), 2.0, 0.3);
        for share in [1e-6, 1e-3, 0.1, 1.0, 3.0] {
            let energy = share * barrier.stiffness * area * barrier.gap * barrier.gap;
            let speed = (2.0 * energy / mass).sqrt();
            let (mut x, mut v, height) = ([0.0, 0.15], [0.0, -speed], 0.15);
            let mut steps = 0;
            while v[1] < 0.0 || x[1] < height {
                let step = barrier.longest_step(&x, &v, mass, area).expect("outside");
                let step = step.min(0.4 * height / speed);
                v[1] += step * area / mass * barrier.traction(&x)[1];
                x[1] += step * v[1];
                steps += 1;
                assert!(steps < 1000);
            }
            assert!(
                ((v[1] / speed).powi(2) - 1.0).abs() < 0.005,
                "{share}: {}",
                v[1] / speed
            );
        }
    }

    #[test]
    fn the_turning_point_has_the_energy() {
        let barrier = floor();
        for g in [1e-9, 1e-3, 0.05, 0.0999] {
            let found = barrier.turning_point(barrier.energy(g));
            assert!(found <= g * (1.0 + 1e-12) && found > g * (1.0 - 1e-6), "{g}: {found}");
        }
    }

    #[test]
    fn a_particle_at_the_surface_is_an_error_and_one_on_its_way_gets_half_the_way() {
        let barrier = floor();
        assert_eq!(barrier.longest_step(&[0.0, -0.5], &[0.0, 0.0], 1.0, 1.0), Err(-0.5));
        assert_eq!(barrier.longest_step(&[0.0, 2.0], &[0.0, -4.0], 1.0, 1.0), Ok(0.25));
        assert_eq!(
            barrier.longest_step(&[0.0, 2.0], &[0.0, 4.0], 1.0, 1.0),
            Ok(f64::INFINITY)
        );
    }
}
