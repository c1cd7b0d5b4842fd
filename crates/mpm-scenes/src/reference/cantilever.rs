//! A cantilever that bends under its weight: Timoshenko's beam in plane strain.

use std::f64::consts::PI;

use super::curve::Curve;
use super::parts::{Rows, Run, gravity, sides, solid};
use crate::ValidationRow;

/// A beam of length l and height h, clamped at x = 0, in plane strain, with Young's modulus E, Poisson's ratio ν, density ρ
/// and gravity g. Everything per unit width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cantilever {
    /// l.
    pub length: f64,
    /// h.
    pub height: f64,
    /// E.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// ρ.
    pub density: f64,
    /// g.
    pub gravity: f64,
}

/// κ = 5/6, the shear coefficient of the rectangle.
const SHEAR_COEFFICIENT: f64 = 5.0 / 6.0;

impl Default for Cantilever {
    /// l = 10, h = 2, E = 10⁵, ν = 0.29, ρ = 2, g = 9.81.
    fn default() -> Self {
        Self {
            length: 10.0,
            height: 2.0,
            young_modulus: 1e5,
            poisson_ratio: 0.29,
            density: 2.0,
            gravity: 9.81,
        }
    }
}

impl Cantilever {
    /// E I with E/(1 − ν²), the modulus of plane strain, and I = h³/12.
    pub fn bending_stiffness(&self) -> f64 {
        self.young_modulus / (1.0 - self.poisson_ratio.powi(2)) * self.height.powi(3) / 12.0
    }

    /// κ G A, G = E / 2(1 + ν), A = h.
    pub fn shear_stiffness(&self) -> f64 {
        SHEAR_COEFFICIENT * self.young_modulus / (2.0 * (1.0 + self.poisson_ratio)) * self.height
    }

    /// Weight per unit length, q = ρ g h.
    pub fn load(&self) -> f64 {
        self.density * self.gravity * self.height
    }

    /// Deflection at x by bending, q x² (6l² − 4lx + x²) / 24EI, of the linear theory: q l⁴ / 8EI at the tip.
    pub fn bending_deflection(&self, x: f64) -> f64 {
        let l = self.length;
        self.load() * x * x * (6.0 * l * l - 4.0 * l * x + x * x) / (24.0 * self.bending_stiffness())
    }

    /// Deflection at x by shear, q (lx − x²/2) / κGA, of the linear theory: q l² / 2κGA at the tip.
    pub fn shear_deflection(&self, x: f64) -> f64 {
        self.load() * (self.length * x - 0.5 * x * x) / self.shear_stiffness()
    }

    /// Both.
    pub fn deflection(&self, x: f64) -> f64 {
        self.bending_deflection(x) + self.shear_deflection(x)
    }

    /// First frequency of Euler and Bernoulli's beam in Hz, (1.8751/l)² √(EI/ρh) / 2π.
    pub fn slender_frequency(&self) -> f64 {
        const FIRST_ROOT: f64 = 1.875_104_068_711_961;
        let root = (self.bending_stiffness() / (self.density * self.height)).sqrt();
        (FIRST_ROOT / self.length).powi(2) * root / (2.0 * PI)
    }

    /// First frequency of Timoshenko's beam in Hz, with shear and rotary inertia.
    ///
    /// With b² = ρA l⁴ω²/EI, r² = I/(A l²), s² = EI/(κGA l²) and
    /// α, β = √((∓(r² + s²) + √((r² − s²)² + 4/b²)) / 2) it is the smallest root of
    /// 2 + [b² (r² − s²)² + 2] cosh bα cos bβ − b (r² + s²)/√(1 − b² r² s²) sinh bα sin bβ = 0
    /// (Huang, *J. Appl. Mech.* 28, 1961, table 1), here by bisection below the slender beam's.
    pub fn frequency(&self) -> f64 {
        let scale = (self.bending_stiffness() / (self.density * self.height)).sqrt() / self.length.powi(2);
        let rotary = self.height.powi(2) / (12.0 * self.length.powi(2));
        let shear = self.bending_stiffness() / (self.shear_stiffness() * self.length.powi(2));
        let determinant = |b: f64| {
            let root = ((rotary - shear).powi(2) + 4.0 / (b * b)).sqrt();
            let alpha = ((root - rotary - shear) / 2.0).sqrt();
            let beta = ((root + rotary + shear) / 2.0).sqrt();
            2.0 + (b * b * (rotary - shear).powi(2) + 2.0) * (b * alpha).cosh() * (b * beta).cos()
                - b * (rotary + shear) / (1.0 - b * b * rotary * shear).sqrt() * (b * alpha).sinh() * (b * beta).sin()
        };
        let slender = 2.0 * PI * self.slender_frequency() / scale;
        let (mut low, mut high) = (0.1 * slender, slender);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if determinant(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high) * scale / (2.0 * PI)
    }

    /// Frequency in Hz of a swing about `level`: whole periods between the times that it passes it; NaN with fewer than three.
    pub fn measured_frequency(swing: &Curve, level: f64) -> f64 {
        let crossings = swing.crossings(level);
        let periods = crossings.len().saturating_sub(1) / 2;
        match (crossings.first(), crossings.get(2 * periods)) {
            (Some(first), Some(last)) if periods > 0 => periods as f64 / (last - first),
            _ => f64::NAN,
        }
    }
}

/// The share of gravity that the linear theory is compared at.
pub const SMALL_LOAD: f64 = 0.01;

/// The tip of a fine cubic run with full load: t, displacement y of the probe `tip`.
const FINE_RUN: &str = include_str!("../../data/cantilever_tip.csv");

/// The beam of a scene, with full load.
fn of_scene(run: &Run, load: f64) -> Result<Cantilever, crate::SceneFault> {
    let (material, _) = solid(run.scene)?;
    let sides = sides(run.scene)?;
    let side = |axis: usize| sides.get(axis).copied().unwrap_or(f64::NAN);
    Ok(Cantilever {
        length: side(0),
        height: side(1),
        young_modulus: material.young_modulus,
        poisson_ratio: material.poisson_ratio,
        density: material.density,
        gravity: gravity(run.scene) / load,
    })
}

/// The full-load equivalent of the tip at the end of a damped run with a hundredth of the load; the probe `tip` has the
/// mean over the outermost twentieth of the length, whose middle is at 39/40 of it.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) for a scene that is no beam.
pub(super) fn validate_static(run: &Run) -> Rows {
    let beam = of_scene(run, SMALL_LOAD)?;
    let tip = run.curve("tip_displacement_y")?;
    let measured = -tip.last() / SMALL_LOAD;
    let scale = beam.deflection(beam.length) / beam.deflection(0.975 * beam.length);
    let expected = beam.deflection(beam.length);
    let name = "deflection of the tip, full-load equivalent";
    Ok(vec![ValidationRow::near(
        name,
        measured * scale,
        expected,
        0.02 * expected,
    )])
}

/// The frequency of a run without damping and with a hundredth of the load, against Timoshenko's beam and against the slender one, which
/// leaves out shear and rotary inertia.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) for a scene that is no beam.
pub(super) fn validate_frequency(run: &Run) -> Rows {
    let beam = of_scene(run, SMALL_LOAD)?;
    let tip = run.curve("tip_displacement_y")?;
    let level = tip.values.iter().sum::<f64>() / tip.values.len().max(1) as f64;
    let measured = Cantilever::measured_frequency(&tip, level);
    let (thick, slender) = (beam.frequency(), beam.slender_frequency());
    Ok(vec![
        ValidationRow::near("first frequency, Timoshenko", measured, thick, 0.02 * thick),
        ValidationRow::near("first frequency, Euler-Bernoulli", measured, slender, 0.02 * slender),
    ])
}

/// The tip of the fine run (`data/README.md`).
pub fn fine_run() -> Curve {
    Curve::parse(FINE_RUN)
}

/// Root mean square difference of the tip to the fine run over 3 s, over its peak.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) without the probe `tip`.
pub(super) fn validate_dynamic(run: &Run) -> Rows {
    difference_of_tip(run, &fine_run(), 0.02)
}

/// That difference to some fine run, which may be as large as the tolerance.
pub(super) fn difference_of_tip(run: &Run, fine: &Curve, tolerance: f64) -> Rows {
    let tip = run.curve("tip_displacement_y")?;
    let error = tip.rms_difference(3.0, |time| fine.at(time).unwrap_or(f64::NAN)) / fine.peak();
    let name = "difference of the tip to the fine run, 3 s / peak";
    Ok(vec![ValidationRow::at_most(name, error, tolerance)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_figures_of_the_problem_come_out() {
        let beam = Cantilever::default();
        assert!((beam.bending_deflection(10.0) - 0.674).abs() < 5e-4);
        assert!((beam.shear_deflection(10.0) - 0.030).abs() < 5e-4);
        assert!((beam.slender_frequency() - 0.755).abs() < 5e-4);
    }

    #[test]
    fn a_slender_beam_has_the_frequency_of_euler_and_bernoulli() {
        let beam = Cantilever {
            height: 0.02,
            ..Cantilever::default()
        };
        assert!((beam.frequency() / beam.slender_frequency() - 1.0).abs() < 1e-5);
    }

    /// Dunkerley's bound 1/f² = 1/f_bending² + 1/f_shear² + … lies below, bending alone above.
    #[test]
    fn shear_and_rotary_inertia_lower_the_frequency_as_much_as_dunkerley_says() {
        let beam = Cantilever::default();
        let shear = (beam.shear_stiffness() / (beam.density * beam.height)).sqrt() / (4.0 * beam.length);
        let bound = (beam.slender_frequency().powi(-2) + shear.powi(-2)).powf(-0.5);
        assert!(beam.frequency() < beam.slender_frequency());
        assert!(
            (beam.frequency() / bound - 1.0).abs() < 0.01,
            "{} {bound}",
            beam.frequency()
        );
    }

    #[test]
    fn the_frequency_of_a_cosine_is_measured() {
        let mut tip = Curve::default();
        for k in 0..2000 {
            let t = 0.005 * f64::from(k);
            tip.push(t, -0.7 * (1.0 - (2.0 * PI * 0.75 * t).cos()));
        }
        assert!((Cantilever::measured_frequency(&tip, -0.7) - 0.75).abs() < 1e-4);
    }
}
