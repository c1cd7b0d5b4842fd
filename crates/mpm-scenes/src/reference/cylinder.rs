//! A thick-walled cylinder under pressure from inside (Lamé & Clapeyron 1831), in plane strain.

use mpm_tensor::Matrix;

use super::parts::{Rows, Run, solid, unfit};
use super::plane_stress::{point, recovered_stresses, stresses};
use crate::scene::{FacetTable, PressureTable, ShapeTable};
use crate::{Scene, Snapshot, ValidationRow};

/// A ring of radii a < b with pressure p at a, small strains, plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThickWalledCylinder {
    /// The centre.
    pub centre: [f64; 2],
    /// a.
    pub inner: f64,
    /// b.
    pub outer: f64,
    /// p.
    pub pressure: f64,
    /// E.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
}

impl ThickWalledCylinder {
    /// The ring that the first body of a plane scene is, of one elastic solid, under the pressure of its first loaded facets.
    pub fn of(scene: &Scene) -> Option<Self> {
        let ShapeTable::Difference { from, remove } = &scene.bodies.first()?.shape else {
            return None;
        };
        let disk = |shape: &ShapeTable| match shape {
            ShapeTable::Sphere { centre, radius } => Some((<[f64; 2]>::try_from(centre.as_slice()).ok()?, *radius)),
            _ => None,
        };
        let (outside, inside) = (disk(from)?, disk(remove.first()?)?);
        let (_, moduli) = solid(scene).ok()?;
        let uniform = |table: &FacetTable| match table.pressure {
            Some(PressureTable::Uniform(pressure)) => Some(pressure),
            _ => None,
        };
        let pressure = scene.facets.iter().find_map(uniform)?;
        (outside.0 == inside.0 && remove.len() == 1).then_some(Self {
            centre: outside.0,
            inner: inside.1,
            outer: outside.1,
            pressure,
            young_modulus: moduli.young_modulus(),
            poisson_ratio: moduli.poisson_ratio(),
        })
    }

    /// p a² / (b² − a²).
    fn mean(&self) -> f64 {
        let (a, b) = (self.inner.powi(2), self.outer.powi(2));
        self.pressure * a / (b - a)
    }

    /// u(r) = (1 + ν) / E · p a² / (b² − a²) · [(1 − 2ν) r + b² / r], along the radius.
    pub fn displacement(&self, radius: f64) -> f64 {
        let shape = (1.0 - 2.0 * self.poisson_ratio) * radius + self.outer.powi(2) / radius;
        (1.0 + self.poisson_ratio) / self.young_modulus * self.mean() * shape
    }

    /// σ_rr(r) and σ_θθ(r) = p a² / (b² − a²) · (1 ∓ b² / r²).
    pub fn stress(&self, radius: f64) -> [f64; 2] {
        let ratio = (self.outer / radius).powi(2);
        [1.0 - ratio, 1.0 + ratio].map(|factor| self.mean() * factor)
    }

    /// Root mean square over the particles, by volume, of the error of the displacement, over u(a).
    #[allow(non_snake_case)]
    fn error_of_displacements(&self, run: &Run) -> f64 {
        let error = run.position_error(|X, _| {
            let r = [X[0] - self.centre[0], X[1] - self.centre[1]];
            let radius = r[0].hypot(r[1]);
            let stretch = 1.0 + self.displacement(radius) / radius;
            [self.centre[0] + stretch * r[0], self.centre[1] + stretch * r[1]]
        });
        error / self.displacement(self.inner)
    }

    /// Root mean square over the particles, by volume, of the error of their stresses in the plane (Frobenius norm), over σ(a).
    fn error_of_stresses(&self, last: &Snapshot, stresses: &[Matrix<2>]) -> f64 {
        let (mut squares, mut volumes) = (0.0, 0.0);
        for (p, (&volume, sigma)) in last.reference_volumes.iter().zip(stresses).enumerate() {
            let x = point(last, &last.reference_positions, p);
            let r = [x[0] - self.centre[0], x[1] - self.centre[1]];
            let radius = r[0].hypot(r[1]);
            let n = r.map(|c| c / radius);
            let [radial, hoop] = self.stress(radius);
            let along = Matrix::outer(&n, &n);
            let exact = along * radial + (Matrix::IDENTITY - along) * hoop;
            squares += volume * (*sigma - exact).frobenius_norm().powi(2);
            volumes += volume;
        }
        let [radial, hoop] = self.stress(self.inner);
        (squares / volumes).sqrt() / radial.hypot(hoop)
    }
}

/// Displacements and stresses at rest within 2 % of Lamé's, root mean squares over the particles over the largest: stresses of single particles, and recovered ones.
///
/// # Errors
/// [`crate::SceneFault::Value`] for a scene that is no such ring.
pub(super) fn validate(run: &Run) -> Rows {
    let expected = "for a ring of one elastic solid with a pressure on facets";
    let ring = ThickWalledCylinder::of(run.scene).ok_or_else(|| unfit(run.scene, expected))?;
    let single = stresses(run.last);
    let of_single = ring.error_of_stresses(run.last, &single);
    let recovered = recovered_stresses(run, &single, &[])?;
    let of_recovered = ring.error_of_stresses(run.last, &recovered);
    let displacement = ring.error_of_displacements(run);
    Ok(vec![
        ValidationRow::at_most("error of displacements / largest", displacement, 0.02),
        ValidationRow::at_most("error of stresses / largest", of_single, 0.02),
        ValidationRow::at_most("error of recovered stresses / largest", of_recovered, 0.02),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hooke's law in plane strain by differences of u, equilibrium, and the pressures at both radii.
    #[test]
    fn solves_the_equations() {
        let ring = ThickWalledCylinder {
            centre: [0.0; 2],
            inner: 1.0,
            outer: 2.0,
            pressure: 3.0,
            young_modulus: 700.0,
            poisson_ratio: 0.3,
        };
        let (e, nu) = (ring.young_modulus, ring.poisson_ratio);
        let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 + 2.0 * nu));
        let slope = |f: &dyn Fn(f64) -> f64, r: f64| (f(r + 1e-5) - f(r - 1e-5)) / 2e-5;
        for r in [1.0, 1.3, 1.9] {
            let (radial, hoop) = (slope(&|r| ring.displacement(r), r), ring.displacement(r) / r);
            let trace = lambda * (radial + hoop);
            let [sigma_r, sigma_t] = ring.stress(r);
            assert!((trace + 2.0 * mu * radial - sigma_r).abs() < 1e-6);
            assert!((trace + 2.0 * mu * hoop - sigma_t).abs() < 1e-6);
            assert!((slope(&|r| ring.stress(r)[0], r) + (sigma_r - sigma_t) / r).abs() < 1e-6);
        }
        assert!((ring.stress(1.0)[0] + 3.0).abs() < 1e-12 && ring.stress(2.0)[0].abs() < 1e-12);
    }
}
