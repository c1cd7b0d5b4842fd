//! The generalized vortex, a manufactured solution with large rotation and shear (Kamojjala, Brannon, Sadeghirad &
//! Guilkey, *Verification tests in solid mechanics*, Eng. Comput. 31, 2015, §4).

use std::f64::consts::PI;

use mpm_materials::ElasticModuli;

use super::parts::{Rows, Run, plane_solid};
use crate::{ManufacturedSolution, Scene, SceneFault, ValidationRow};

/// Every circle of the ring R_i ≤ R ≤ R_o turns by α(R, t) = A g(t) h(R) about the origin, g = sin(πt/T),
/// h = 1 − 8 s² + 16 s⁴, s = (R − R̄)/(R_o − R_i), R̄ = (R_i + R_o)/2, for the Neo-Hookean solid of
/// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ in plane strain.
///
/// J = 1, so λ does not matter. On both edges h = h' = 0: they stay where they are and carry no traction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralizedVortex {
    /// A, in radians.
    pub amplitude: f64,
    /// T: the ring is back at t = T.
    pub period: f64,
    /// R_i.
    pub inner_radius: f64,
    /// R_o.
    pub outer_radius: f64,
    /// λ and μ.
    pub moduli: ElasticModuli,
    /// ρ₀.
    pub density: f64,
}

/// A turn by α, with its derivatives.
struct Turn {
    angle: f64,
    /// α', α''.
    slope: f64,
    curvature: f64,
    /// ∂α/∂t, ∂²α/∂t².
    rate: f64,
    acceleration: f64,
}

impl GeneralizedVortex {
    fn turn(&self, radius: f64, time: f64) -> Turn {
        let width = self.outer_radius - self.inner_radius;
        let s = (radius - 0.5 * (self.inner_radius + self.outer_radius)) / width;
        let shape = 1.0 - 8.0 * s.powi(2) + 16.0 * s.powi(4);
        let (sin, cos) = (PI * time / self.period).sin_cos();
        let frequency = PI / self.period;
        Turn {
            angle: self.amplitude * sin * shape,
            slope: self.amplitude * sin * (-16.0 * s + 64.0 * s.powi(3)) / width,
            curvature: self.amplitude * sin * (-16.0 + 192.0 * s.powi(2)) / (width * width),
            rate: self.amplitude * frequency * cos * shape,
            acceleration: -self.amplitude * frequency * frequency * sin * shape,
        }
    }

    /// R, and the axes e_r, e_θ at the place that the particle of X has come to.
    #[allow(non_snake_case)]
    fn polar(&self, X: &[f64; 2], time: f64) -> (f64, Turn, [f64; 2], [f64; 2]) {
        let radius = X[0].hypot(X[1]);
        let turn = self.turn(radius, time);
        let (sin, cos) = (X[1].atan2(X[0]) + turn.angle).sin_cos();
        (radius, turn, [cos, sin], [-sin, cos])
    }
}

#[allow(non_snake_case)]
impl ManufacturedSolution for GeneralizedVortex {
    /// x(X, t) = R e_r.
    fn position(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let (radius, _, e_r, _) = self.polar(X, time);
        e_r.map(|c| radius * c)
    }

    /// v(X, t) = R ∂α/∂t e_θ.
    fn velocity(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let (radius, turn, _, e_theta) = self.polar(X, time);
        e_theta.map(|c| radius * turn.rate * c)
    }

    /// b = ẍ − Div P / ρ₀ = R [μ/ρ₀ α'² − α̇²] e_r + [R α̈ − μ/ρ₀ (3α' + R α'')] e_θ.
    ///
    /// With k = R α' the stress is P = μ k (e_θ ⊗ E_R + e_r ⊗ E_Θ), and Div P = μ [(k' + 2k/R) e_θ − k α' e_r].
    fn body_force(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let (radius, turn, e_r, e_theta) = self.polar(X, time);
        let stiffness = self.moduli.shear_modulus() / self.density;
        let radial = radius * (stiffness * turn.slope.powi(2) - turn.rate.powi(2));
        let hoop = radius * turn.acceleration - stiffness * (3.0 * turn.slope + radius * turn.curvature);
        std::array::from_fn(|a| radial * e_r[a] + hoop * e_theta[a])
    }
}

/// The ring 0.75 ≤ R ≤ 1.25 with A = 0.1 and T = 1 in the material of a scene.
///
/// # Errors
/// [`SceneFault::Value`] for a scene without one elastic material, or not of two dimensions.
pub(super) fn of_scene(scene: &Scene) -> Result<GeneralizedVortex, SceneFault> {
    let (material, moduli) = plane_solid(scene)?;
    Ok(GeneralizedVortex {
        amplitude: 0.1,
        period: 1.0,
        inner_radius: 0.75,
        outer_radius: 1.25,
        moduli,
        density: material.density,
    })
}

/// The error of the positions at the end in the L² norm over the way A R̄ of the middle circle: at most 3 %, which h = 1/32 reaches.
///
/// # Errors
/// As [`of_scene`].
pub(super) fn validate(run: &Run) -> Rows {
    let exact = of_scene(run.scene)?;
    let error = run.position_error(|start, time| exact.position(start, time));
    let way = exact.amplitude * 0.5 * (exact.inner_radius + exact.outer_radius);
    let name = "L2 error of the positions at the end / largest way";
    Ok(vec![ValidationRow::at_most(name, error / way, 0.03)])
}

#[cfg(test)]
#[allow(non_snake_case)]
mod tests {
    use mpm_tensor::Matrix;

    use super::super::dual::{Motion, Number, assert_moves_by_its_force, deformation_gradient};
    use super::*;

    fn solution() -> GeneralizedVortex {
        GeneralizedVortex {
            amplitude: 1.0,
            period: 1.0,
            inner_radius: 0.75,
            outer_radius: 1.25,
            moduli: ElasticModuli::new(1000.0, 0.3).expect("in range"),
            density: 1000.0,
        }
    }

    /// The motion as the title states it.
    struct Stated(GeneralizedVortex);

    impl Motion for Stated {
        fn position<N: Number>(&self, X: [N; 2], t: N) -> [N; 2] {
            let v = &self.0;
            let R = (X[0] * X[0] + X[1] * X[1]).sqrt();
            let mean = N::constant(0.5 * (v.inner_radius + v.outer_radius));
            let s = (R - mean) / N::constant(v.outer_radius - v.inner_radius);
            let h = N::constant(1.0) - N::constant(8.0) * s * s + N::constant(16.0) * s * s * s * s;
            let alpha = N::constant(v.amplitude) * (N::constant(PI / v.period) * t).sin() * h;
            [
                alpha.cos() * X[0] - alpha.sin() * X[1],
                alpha.sin() * X[0] + alpha.cos() * X[1],
            ]
        }
    }

    #[test]
    fn velocity_and_body_force_are_those_of_the_motion() {
        let exact = solution();
        let places = [([0.8, 0.2], 0.1), ([-0.5, 0.9], 0.5), ([0.1, -1.2], 0.83)];
        assert_moves_by_its_force(&exact, &Stated(exact), (&exact.moduli, exact.density), places);
        for (X, t) in places {
            let F = Matrix(deformation_gradient(&Stated(exact), X, t));
            assert!((F.determinant() - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn the_edges_stay_and_carry_no_traction() {
        let exact = solution();
        for radius in [0.75, 1.25] {
            for angle in [0.3f64, 2.0, 4.4] {
                let X = [radius * angle.cos(), radius * angle.sin()];
                let x = exact.position(&X, 0.3);
                assert!((x[0] - X[0]).hypot(x[1] - X[1]) < 1e-14);
                let F = Matrix(deformation_gradient(&Stated(exact), X, 0.3));
                assert!((F - Matrix::IDENTITY).frobenius_norm() < 1e-13);
            }
        }
    }
}
