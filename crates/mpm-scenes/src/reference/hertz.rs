//! A cylinder that lies on a rigid plane (Hertz 1882), in plane strain.

use mpm_tensor::Matrix;

use super::parts::{Rows, Run, gravity, solid, unfit};
use super::plane_stress::{point, recovered_stresses, stress_error, stresses};
use crate::scene::ShapeTable;
use crate::{Scene, Snapshot, ValidationRow};

/// A cylinder of radius R that a force P per length presses on a rigid plane without friction, small strains, plane strain: the pressure is p0 √(1 − (x/b)²) with
///
/// b = √(4 P R (1 − ν²) / (π E)), p0 = 2 P / (π b).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderOnPlane {
    /// R.
    pub radius: f64,
    /// E / (1 − ν²).
    pub modulus: f64,
}

/// How far from the middle of the contact stresses are compared, in half-widths.
const NEAR: f64 = 3.0;

impl CylinderOnPlane {
    /// The disk that the first body of a plane scene is, of one elastic solid, under gravity along −y above a barrier along x.
    pub fn of(scene: &Scene) -> Option<Self> {
        let ShapeTable::Sphere { radius, .. } = &scene.bodies.first()?.shape else {
            return None;
        };
        let barrier = scene.barrier.as_ref()?;
        let [ShapeTable::HalfSpace { normal, .. }] = barrier.shapes.as_slice() else {
            return None;
        };
        let (_, moduli) = solid(scene).ok()?;
        let up = matches!(normal.as_slice(), [0.0, y] if *y > 0.0);
        let down = matches!(scene.gravity.as_slice(), [0.0, g] if *g < 0.0);
        let alone = scene.bodies.len() == 1 && scene.loads.is_empty() && barrier.against.is_none();
        (up && down && alone && barrier.friction == 0.0).then_some(Self {
            radius: *radius,
            modulus: moduli.young_modulus() / (1.0 - moduli.poisson_ratio().powi(2)),
        })
    }

    /// b under the force P.
    pub fn half_width(&self, force: f64) -> f64 {
        (4.0 * force * self.radius / (std::f64::consts::PI * self.modulus)).sqrt()
    }

    /// σ of a half-space at x beside the middle of the contact and z above the plane (McEwen 1949): with p0 and b of the force P, 2m² = w + (b² − x² + z²), 2n² = w − (b² − x² + z²), w² = (b² − x² + z²)² + 4x²z², k = (z² + n²) / (m² + n²),
    ///
    /// σ_xx = −p0/b [m (1 + k) − 2z], σ_yy = −p0/b m (1 − k), σ_xy = ∓p0/b n (m² − z²) / (m² + n²), − for x > 0.
    pub fn stress_of_contact(&self, force: f64, x: f64, z: f64) -> Matrix<2> {
        let b = self.half_width(force);
        let slope = 2.0 * force / (std::f64::consts::PI * b * b);
        let d = b * b - x * x + z * z;
        let w = d.hypot(2.0 * x * z);
        let (m2, n2) = (0.5 * (w + d).max(0.0), 0.5 * (w - d).max(0.0));
        let (m, n, k) = (m2.sqrt(), n2.sqrt(), (z * z + n2) / w);
        let shear = -slope * n * (m2 - z * z) / w * x.signum();
        Matrix([
            [-slope * (m * (1.0 + k) - 2.0 * z), shear],
            [shear, -slope * m * (1.0 - k)],
        ])
    }

    /// σ where P is the weight of the cylinder: that of the half-space, and with Y = z − R and s = P / (2πR)
    ///
    /// σ_xx = s (1 − Y/R), σ_yy = s (1 + Y/R), σ_xy = s x/R,
    ///
    /// which bear the weight, ∂_a σ_ay = P / (πR²), and with a point force at the lowest point leave no traction on the surface: there −s (n + e_y) is that of the point force, and s (n + e_y) that of these.
    pub fn stress(&self, weight: f64, x: f64, z: f64) -> Matrix<2> {
        let s = weight / (2.0 * std::f64::consts::PI * self.radius);
        let (x_share, y_share) = (x / self.radius, z / self.radius - 1.0);
        let of_weight = Matrix([[1.0 - y_share, x_share], [x_share, 1.0 + y_share]]);
        self.stress_of_contact(weight, x, z) + of_weight * s
    }
}

/// What a half-space takes of a body at rest: positions along x and forces, in order.
struct Contact {
    places: Vec<(f64, f64)>,
    /// Σ F and Σ F x / Σ F.
    total: f64,
    middle: f64,
}

impl Contact {
    fn of(last: &Snapshot) -> Self {
        let forces = last.scalars.iter().find(|(name, _)| name == "contact_force");
        let forces = forces.map_or(&[][..], |(_, forces)| forces);
        let each = forces.iter().enumerate().filter(|(_, force)| **force > 0.0);
        let mut places: Vec<_> = each
            .map(|(p, &force)| (point(last, &last.positions, p)[0], force))
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = places.iter().map(|(_, force)| force).sum();
        let middle = places.iter().map(|(x, force)| x * force).sum::<f64>() / total;
        Self { places, total, middle }
    }

    /// b of the ellipse with the second moment of the forces, Σ F (x − x̄)² / Σ F = b²/4.
    fn half_width(&self) -> f64 {
        let moment: f64 = self.places.iter().map(|(x, f)| f * (x - self.middle).powi(2)).sum();
        2.0 * (moment / self.total).sqrt()
    }

    /// The force on |x − x̄| < `reach`, that of each particle spread evenly as far as half-way to its neighbours.
    fn within(&self, reach: f64) -> f64 {
        let inside = |window: &[(f64, f64)]| {
            let [(before, _), (x, force), (behind, _)] = window else {
                return 0.0;
            };
            let ends = [0.5 * (before + x), 0.5 * (x + behind)].map(|end| end - self.middle);
            let [low, high] = ends.map(|end| end.clamp(-reach, reach));
            force * (high - low) / (ends[1] - ends[0])
        };
        self.places.windows(3).map(inside).sum()
    }
}

/// At rest: force over weight within 1 %, half-width (by the second moment of the forces) and mean pressure of the middle half over Hertz's within 5 %. Root mean squares of the errors of stresses over p0, of particles within three half-widths of the
/// middle of the contact: within 5 %, on a mesh those of recovered ones as well, and within 2 % of those at least b/4 above the lowest particle.
///
/// # Errors
/// [`crate::SceneFault::Value`] for a scene that is no such cylinder.
pub(super) fn validate(run: &Run) -> Rows {
    let expected = "for a disk of one elastic solid under its weight on a half-space that is the barrier";
    let cylinder = CylinderOnPlane::of(run.scene).ok_or_else(|| unfit(run.scene, expected))?;
    let last = run.last;
    let weight = gravity(run.scene) * last.masses.iter().sum::<f64>();
    let (contact, b) = (Contact::of(last), cylinder.half_width(weight));
    // ∫ p dx over |x| < b/2: P (2/π) (√3/4 + π/6).
    let middle = weight * (2.0 / std::f64::consts::PI * 3.0_f64.sqrt() / 4.0 + 1.0 / 3.0);
    let floor = (0..last.len())
        .map(|p| point(last, &last.positions, p)[1])
        .fold(f64::INFINITY, f64::min);
    let seen = |x: &[f64; 2]| (x[0] - contact.middle, x[1] - floor);
    let near = |x: &[f64; 2]| seen(x).0.hypot(seen(x).1) < NEAR * b;
    let exact = |x: &[f64; 2]| cylinder.stress(weight, seen(x).0, seen(x).1);
    let peak = 2.0 * weight / (std::f64::consts::PI * b);
    let error = |stresses: &[Matrix<2>], above: f64| {
        let counted = |x: &[f64; 2]| near(x) && seen(x).1 >= above;
        stress_error(last, &last.positions, stresses, counted, exact) / peak
    };
    let single = stresses(last);
    let mut rows = vec![
        ValidationRow::near("contact force / weight", contact.total / weight, 1.0, 0.01),
        ValidationRow::near("half-width / Hertz", contact.half_width() / b, 1.0, 0.05),
        ValidationRow::near(
            "pressure of the middle half / Hertz",
            contact.within(0.5 * b) / middle,
            1.0,
            0.05,
        ),
        ValidationRow::at_most(
            "error of stresses near the contact / peak pressure",
            error(&single, 0.0),
            0.1,
        ),
        ValidationRow::at_most(
            "error of stresses above b/4 / peak pressure",
            error(&single, 0.25 * b),
            0.02,
        ),
    ];
    if run.scene.mesh.is_some() {
        let recovered = error(&recovered_stresses(run, &single, &[])?, 0.0);
        let quantity = "error of recovered stresses near the contact / peak pressure";
        rows.push(ValidationRow::at_most(quantity, recovered, 0.05));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYLINDER: CylinderOnPlane = CylinderOnPlane {
        radius: 2.0,
        modulus: 700.0,
    };

    /// Equilibrium, a harmonic trace (compatibility), the pressure on the plane, and Flamant's point force far away.
    #[test]
    fn solves_the_equations() {
        let force = 5.0;
        let b = CYLINDER.half_width(force);
        let peak = 2.0 * force / (std::f64::consts::PI * b);
        let step = 1e-3 * b;
        for [x, z] in [[0.3, 0.5], [-0.8, 0.2], [1.4, 0.7], [-2.0, 2.5]].map(|at: [f64; 2]| at.map(|c| c * b)) {
            let at = |i: f64, j: f64| CYLINDER.stress_of_contact(force, x + i * step, z + j * step).0;
            for i in 0..2 {
                let slope = at(1.0, 0.0)[i][0] - at(-1.0, 0.0)[i][0] + at(0.0, 1.0)[i][1] - at(0.0, -1.0)[i][1];
                assert!(slope.abs() / (2.0 * step) < 1e-4 * peak / b, "{x} {z}");
            }
            let trace = |i: f64, j: f64| at(i, j)[0][0] + at(i, j)[1][1];
            let around = trace(1.0, 0.0) + trace(-1.0, 0.0) + trace(0.0, 1.0) + trace(0.0, -1.0);
            assert!((around - 4.0 * trace(0.0, 0.0)).abs() / (step * step) < 1e-3 * peak / (b * b));
        }
        for share in [0.0_f64, 0.4, -0.9] {
            let sigma = CYLINDER.stress_of_contact(force, share * b, 1e-12).0;
            assert!((sigma[1][1] + peak * (1.0 - share * share).sqrt()).abs() < 1e-6 * peak);
            assert!(sigma[0][1].abs() < 1e-6 * peak);
        }
        let far = CYLINDER.stress_of_contact(force, 0.0, 1e3 * b).0[1][1];
        assert!((far * std::f64::consts::PI * 1e3 * b / (-2.0 * force) - 1.0).abs() < 1e-5);
    }

    /// What bears the weight does, and the surface is free far from a small contact.
    #[test]
    fn bears_the_weight() {
        let (weight, radius) = (1e-6, CYLINDER.radius);
        let s = weight / (2.0 * std::f64::consts::PI * radius);
        let at = |x: f64, z: f64| (CYLINDER.stress(weight, x, z) - CYLINDER.stress_of_contact(weight, x, z)).0;
        let step = 1e-3;
        for (i, expected) in [0.0, weight / (std::f64::consts::PI * radius * radius)]
            .into_iter()
            .enumerate()
        {
            let across = at(0.3 + step, 0.5)[i][0] - at(0.3 - step, 0.5)[i][0];
            let along = at(0.3, 0.5 + step)[i][1] - at(0.3, 0.5 - step)[i][1];
            assert!(((across + along) / (2.0 * step) - expected).abs() < 1e-9 * s);
        }
        for angle in [0.5, 1.6, 2.9, -2.0] {
            let n = [f64::sin(angle), -f64::cos(angle)];
            let traction = CYLINDER.stress(weight, radius * n[0], radius * (1.0 + n[1])).apply(&n);
            assert!(traction.iter().all(|t| t.abs() < 1e-6 * s), "{angle}: {traction:?} {s}");
        }
    }

    /// Forces of Hertz's pressure at even distances have its half-width, and its share in the middle half.
    #[test]
    fn reads_an_ellipse() {
        let b = CYLINDER.half_width(5.0);
        let place = |i: i32| {
            let x = f64::from(i) / 200.0;
            (1.0 + b * x, (1.0 - x * x).sqrt())
        };
        let places: Vec<_> = (-199..200).map(place).collect();
        let total = places.iter().map(|(_, force)| force).sum();
        let contact = Contact {
            places,
            total,
            middle: 1.0,
        };
        assert!((contact.half_width() / b - 1.0).abs() < 1e-3);
        assert!((contact.within(0.5 * b) / total - 0.608_998).abs() < 1e-3);
    }
}
