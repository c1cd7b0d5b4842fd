//! A wide plate with a round hole under tension (Kirsch 1898), in plane strain.

use mpm_materials::ElasticModuli;
use mpm_tensor::Matrix;

use super::parts::{Rows, Run, solid, unfit};
use super::plane_stress::{point, recovered_stresses, stress_error, stresses};
use crate::scene::{FacetTable, ShapeTable, VectorTable};
use crate::{Scene, ValidationRow};

/// An infinite plate with a hole of radius a under the stress S along x far away, small strains, plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlateWithHole {
    /// The centre of the hole.
    pub centre: [f64; 2],
    /// a.
    pub radius: f64,
    /// S.
    pub tension: f64,
    /// μ and ν of the material.
    pub moduli: ElasticModuli,
}

/// How far from the hole stresses are compared, in radii from its centre.
const NEAR: f64 = 3.0;

impl PlateWithHole {
    /// The plate that the first body of a plane scene is, of one elastic solid, less a disk, with a traction along x on the facets `x-upper`.
    pub fn of(scene: &Scene) -> Option<Self> {
        let ShapeTable::Difference { remove, .. } = &scene.bodies.first()?.shape else {
            return None;
        };
        let [ShapeTable::Sphere { centre, radius }] = remove.as_slice() else {
            return None;
        };
        let pulled = |table: &FacetTable| match &table.traction {
            Some(VectorTable::Uniform(traction)) if table.group == "x-upper" => match traction[..] {
                [tension, 0.0] => Some(tension),
                _ => None,
            },
            _ => None,
        };
        Some(Self {
            centre: centre.as_slice().try_into().ok()?,
            radius: *radius,
            tension: scene.facets.iter().find_map(pulled)?,
            moduli: solid(scene).ok()?.1,
        })
    }

    /// r and θ about the centre of the hole, θ from the x axis.
    fn polar(&self, x: &[f64; 2]) -> (f64, f64) {
        let [dx, dy] = [x[0] - self.centre[0], x[1] - self.centre[1]];
        (dx.hypot(dy), dy.atan2(dx))
    }

    /// σ in the plane, with q = a² / r²:
    ///
    /// σ_rr = S/2 (1 − q) + S/2 (1 − 4q + 3q²) cos 2θ, σ_θθ = S/2 (1 + q) − S/2 (1 + 3q²) cos 2θ, σ_rθ = −S/2 (1 + 2q − 3q²) sin 2θ.
    pub fn stress(&self, x: &[f64; 2]) -> Matrix<2> {
        let (r, angle) = self.polar(x);
        let (q, half) = ((self.radius / r).powi(2), 0.5 * self.tension);
        let (sin, cos) = (2.0 * angle).sin_cos();
        let radial = half * (1.0 - q + (1.0 - 4.0 * q + 3.0 * q * q) * cos);
        let hoop = half * (1.0 + q - (1.0 + 3.0 * q * q) * cos);
        let shear = -half * (1.0 + 2.0 * q - 3.0 * q * q) * sin;
        let turn = turn(angle);
        turn * Matrix([[radial, shear], [shear, hoop]]) * turn.transpose()
    }

    /// u, with κ = 3 − 4ν and the centre at rest:
    ///
    /// u_r = S / (8μr) [(κ − 1) r² + 2a² + 2 ((κ + 1) a² + r² − a⁴/r²) cos 2θ], u_θ = −S / (4μr) [(κ − 1) a² + r² + a⁴/r²] sin 2θ.
    pub fn displacement(&self, x: &[f64; 2]) -> [f64; 2] {
        let (r, angle) = self.polar(x);
        let (r2, a2) = (r * r, self.radius.powi(2));
        let (kappa, a4) = (3.0 - 4.0 * self.moduli.poisson_ratio(), a2 * a2 / r2);
        let (sin, cos) = (2.0 * angle).sin_cos();
        let scale = self.tension / (4.0 * self.moduli.shear_modulus() * r);
        let radial = scale * (0.5 * (kappa - 1.0) * r2 + a2 + ((kappa + 1.0) * a2 + r2 - a4) * cos);
        let around = -scale * ((kappa - 1.0) * a2 + r2 + a4) * sin;
        turn(angle).apply(&[radial, around])
    }
}

/// The matrix of a turn by this angle.
fn turn(angle: f64) -> Matrix<2> {
    let (sin, cos) = angle.sin_cos();
    Matrix([[cos, -sin], [sin, cos]])
}

/// At rest, root mean squares over the particles: displacements within 2 % of the largest; within three radii of the centre, stresses of single particles and recovered ones within 2 % of 3 S. The recovered stress along the pull at the crown of the hole over S,
/// 3 in an infinite plate, within 5 %.
///
/// # Errors
/// [`crate::SceneFault::Value`] for a scene that is no such plate.
pub(super) fn validate(run: &Run) -> Rows {
    let expected = "for a plate with a round hole of one elastic solid, with a traction along x on `x-upper`";
    let plate = PlateWithHole::of(run.scene).ok_or_else(|| unfit(run.scene, expected))?;
    let last = run.last;
    #[allow(non_snake_case)]
    let moved = |X: &[f64; 2]| {
        let u = plate.displacement(X);
        [X[0] + u[0], X[1] + u[1]]
    };
    let size = |p: usize| {
        let u = plate.displacement(&point(last, &last.reference_positions, p));
        u[0].hypot(u[1])
    };
    let largest = (0..last.len()).map(size).fold(0.0, f64::max);
    let crown = [plate.centre[0], plate.centre[1] + plate.radius];
    let single = stresses(last);
    let mut recovered = recovered_stresses(run, &single, &[crown])?;
    let at_crown = recovered.pop().map_or(f64::NAN, |sigma| sigma.0[0][0] / plate.tension);
    let error = |stresses: &[Matrix<2>]| {
        let near = |x: &[f64; 2]| plate.polar(x).0 < NEAR * plate.radius;
        let error = stress_error(last, &last.reference_positions, stresses, near, |x| plate.stress(x));
        error / (3.0 * plate.tension.abs())
    };
    let displacement = run.position_error(|x, _| moved(x)) / largest;
    Ok(vec![
        ValidationRow::at_most("error of displacements / largest", displacement, 0.02),
        ValidationRow::at_most("error of stresses near the hole / 3 S", error(&single), 0.02),
        ValidationRow::at_most(
            "error of recovered stresses near the hole / 3 S",
            error(&recovered),
            0.02,
        ),
        ValidationRow::near("recovered stress at the crown / S", at_crown, 3.0, 0.15),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hooke's law in plane strain by differences of u, equilibrium by differences of σ, no traction at the hole, 3 S at its crown, S far away.
    #[test]
    fn solves_the_equations() {
        let plate = PlateWithHole {
            centre: [0.3, -0.2],
            radius: 0.7,
            tension: 2.0,
            moduli: ElasticModuli::new(700.0, 0.3).expect("moduli"),
        };
        let (e, nu) = (700.0, 0.3);
        let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 + 2.0 * nu));
        let shifted = |x: &[f64; 2], a: usize, by: f64| {
            let mut x = *x;
            x[a] += by;
            x
        };
        for x in [[1.1, 0.1], [0.3, 0.6], [-0.9, -1.1], [2.0, 1.0]] {
            let step = 1e-5;
            let slope = |i: usize, a: usize| {
                let u = |by| plate.displacement(&shifted(&x, a, by))[i];
                (u(step) - u(-step)) / (2.0 * step)
            };
            let strain = Matrix::<2>::from_fn(|i, j| 0.5 * (slope(i, j) + slope(j, i)));
            let expected = Matrix::IDENTITY * (lambda * (strain.0[0][0] + strain.0[1][1])) + strain * (2.0 * mu);
            assert!((plate.stress(&x) - expected).maximum_norm() < 1e-6, "{x:?}");
            for i in 0..2 {
                let of = |a: usize, by| plate.stress(&shifted(&x, a, by)).0[i][a];
                let divergence: f64 = (0..2).map(|a| (of(a, step) - of(a, -step)) / (2.0 * step)).sum();
                assert!(divergence.abs() < 1e-6, "{x:?}: {divergence}");
            }
        }
        for angle in [0.0, 0.4, 1.5] {
            let n = [f64::cos(angle), f64::sin(angle)];
            let rim = [0.3 + 0.7 * n[0], -0.2 + 0.7 * n[1]];
            assert!(plate.stress(&rim).apply(&n).iter().all(|t| t.abs() < 1e-12));
        }
        assert!((plate.stress(&[0.3, 0.5]).0[0][0] - 6.0).abs() < 1e-12);
        assert!((plate.stress(&[700.0, 900.0]) - Matrix([[2.0, 0.0], [0.0, 0.0]])).maximum_norm() < 1e-5);
    }
}
