//! The axis-aligned manufactured solution (Wallstedt & Guilkey 2008, §4; Kamojjala, Brannon, Sadeghirad & Guilkey 2015).

use std::f64::consts::PI;

use mpm_materials::ElasticModuli;

use super::parts::{Rows, Run, plane_solid};
use crate::{ManufacturedSolution, Scene, SceneFault, ValidationRow};

/// u_a = A sin(2πX_a) sin(cπt + φ_a) in the unit square, φ = (0, π), for the Neo-Hookean solid
/// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ in plane strain.
///
/// F is diagonal and u_a vanishes on X_a ∈ {0, 1}, so the faces glide on frictionless walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisAligned {
    /// A, at most 1/2π: beyond, F_aa = 1 + 2πA cos 2πX_a sin(…) changes its sign.
    pub amplitude: f64,
    /// λ and μ.
    pub moduli: ElasticModuli,
    /// ρ₀.
    pub density: f64,
}

impl AxisAligned {
    /// c = √((λ + 2μ)/ρ₀), so that the period is 2 / c.
    pub fn wave_speed(&self) -> f64 {
        (self.moduli.p_wave_modulus() / self.density).sqrt()
    }

    /// sin(cπt + φ_a) and its first two derivatives.
    fn time_factor(&self, time: f64) -> [[f64; 3]; 2] {
        let rate = PI * self.wave_speed();
        [0.0, PI].map(|phase: f64| {
            let (sin, cos) = (rate * time + phase).sin_cos();
            [sin, rate * cos, -rate * rate * sin]
        })
    }

    /// u(X, t).
    #[allow(non_snake_case)]
    fn displacement(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let factor = self.time_factor(time);
        std::array::from_fn(|a| self.amplitude * (2.0 * PI * X[a]).sin() * factor[a][0])
    }

    /// F_aa(X, t) = 1 + 2πA cos 2πX_a sin(cπt + φ_a).
    #[allow(non_snake_case)]
    fn stretches(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let factor = self.time_factor(time);
        std::array::from_fn(|a| 1.0 + 2.0 * PI * self.amplitude * (2.0 * PI * X[a]).cos() * factor[a][0])
    }
}

#[allow(non_snake_case)]
impl ManufacturedSolution for AxisAligned {
    /// X + u(X, t).
    fn position(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let u = self.displacement(X, time);
        [X[0] + u[0], X[1] + u[1]]
    }

    /// u̇(X, t).
    fn velocity(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let factor = self.time_factor(time);
        std::array::from_fn(|a| self.amplitude * (2.0 * PI * X[a]).sin() * factor[a][1])
    }

    /// b = ü − Div P / ρ₀, with (Div P)_a = F_aa' [μ (1 + F_aa⁻²) + λ (1 − ln J) F_aa⁻²] and
    /// F_aa' = ∂F_aa/∂X_a = −4π² u_a.
    fn body_force(&self, X: &[f64; 2], time: f64) -> [f64; 2] {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        let stretches = self.stretches(X, time);
        let log_J = (stretches[0] * stretches[1]).ln();
        let u = self.displacement(X, time);
        let rate = PI * self.wave_speed();
        std::array::from_fn(|a| {
            let inverse_square = stretches[a].powi(-2);
            let stiffness = mu * (1.0 + inverse_square) + lambda * (1.0 - log_J) * inverse_square;
            -rate * rate * u[a] + 4.0 * PI * PI * u[a] * stiffness / self.density
        })
    }
}

/// The solution with A = 0.02 in the material of a scene.
///
/// # Errors
/// [`SceneFault::Value`] for a scene without one elastic material, or not of two dimensions.
pub(super) fn of_scene(scene: &Scene) -> Result<AxisAligned, SceneFault> {
    let (material, moduli) = plane_solid(scene)?;
    Ok(AxisAligned {
        amplitude: 0.02,
        moduli,
        density: material.density,
    })
}

/// The error of the displacement at the end in the L² norm over the amplitude: at most 3 %, which 32 cells per side reach.
///
/// # Errors
/// As [`of_scene`].
pub(super) fn validate(run: &Run) -> Rows {
    let exact = of_scene(run.scene)?;
    let error = run.position_error(|start, time| exact.position(start, time));
    let name = "L2 error of the displacement at the end / amplitude";
    Ok(vec![ValidationRow::at_most(name, error / exact.amplitude, 0.03)])
}

#[cfg(test)]
#[allow(non_snake_case)]
mod tests {
    use super::super::dual::{Motion, Number, assert_moves_by_its_force};
    use super::*;

    fn solution() -> AxisAligned {
        AxisAligned {
            amplitude: 0.05,
            moduli: ElasticModuli::new(1e4, 0.3).expect("in range"),
            density: 1e3,
        }
    }

    /// The motion as the title states it.
    struct Stated(AxisAligned);

    impl Motion for Stated {
        fn position<N: Number>(&self, X: [N; 2], t: N) -> [N; 2] {
            let wave = N::constant(PI * self.0.wave_speed()) * t;
            let phases = [wave, wave + N::constant(PI)];
            std::array::from_fn(|a| {
                X[a] + N::constant(self.0.amplitude) * (N::constant(2.0 * PI) * X[a]).sin() * phases[a].sin()
            })
        }
    }

    #[test]
    fn velocity_and_body_force_are_those_of_the_motion() {
        let exact = solution();
        let places = [([0.13, 0.71], 0.11), ([0.5, 0.02], 0.4), ([0.93, 0.33], 0.77)];
        assert_moves_by_its_force(&exact, &Stated(exact), (&exact.moduli, exact.density), places);
    }

    #[test]
    fn the_faces_do_not_leave_the_unit_square() {
        for t in [0.1, 0.3] {
            for face in [0.0, 1.0] {
                assert!(solution().displacement(&[face, 0.3], t)[0].abs() < 1e-15);
                assert!(solution().displacement(&[0.3, face], t)[1].abs() < 1e-15);
            }
        }
    }
}
