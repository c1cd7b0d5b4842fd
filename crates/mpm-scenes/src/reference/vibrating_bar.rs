//! A bar that vibrates in its first mode, one end held (Sulsky, Chen & Schreyer 1994; de Vaucorbeil et al. 2020, §5.1).

use std::f64::consts::PI;

use super::Displacement;
use super::curve::Curve;
use super::parts::{Rows, Run, sides, solid};
use crate::scene::{VectorField, VectorTable};
use crate::{Scene, SceneFault, ValidationRow};

/// A bar 0 ≤ X ≤ L with u(0, t) = 0, no traction at X = L and P = E (F − 1), for which the equation of motion
/// ρ ü = E u'' is linear at any amplitude.
///
/// With v(X, 0) = v₀ sin β₁X, β₁ = π / 2L, its motion is u = v₀/ω₁ sin ω₁t sin β₁X, ω₁ = β₁ √(E/ρ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VibratingBar {
    /// L.
    pub length: f64,
    /// E.
    pub young_modulus: f64,
    /// ρ.
    pub density: f64,
    /// v₀.
    pub speed: f64,
}

impl VibratingBar {
    /// β₁ = π / 2L.
    pub fn wave_number(&self) -> f64 {
        PI / (2.0 * self.length)
    }

    /// ω₁ = β₁ √(E/ρ).
    pub fn angular_frequency(&self) -> f64 {
        self.wave_number() * (self.young_modulus / self.density).sqrt()
    }

    /// 2π / ω₁.
    pub fn period(&self) -> f64 {
        2.0 * PI / self.angular_frequency()
    }

    /// u(X, t) = v₀/ω₁ sin ω₁t sin β₁X.
    pub fn displacement(&self, x: f64, time: f64) -> f64 {
        let omega = self.angular_frequency();
        self.speed / omega * (omega * time).sin() * (self.wave_number() * x).sin()
    }

    /// Amplitude of the centre of mass, v₀ / (β₁ L ω₁).
    pub fn amplitude(&self) -> f64 {
        self.speed / (self.wave_number() * self.length * self.angular_frequency())
    }

    /// x_CM(t) = L/2 + v₀ / (β₁ L ω₁) sin ω₁t.
    pub fn centre_of_mass(&self, time: f64) -> f64 {
        0.5 * self.length + self.amplitude() * (self.angular_frequency() * time).sin()
    }

    /// Root mean square error of a measured centre of mass over the first period, over the [amplitude](Self::amplitude).
    pub fn relative_error(&self, centre: &Curve) -> f64 {
        let end = self.period() * (1.0 + 1e-9);
        centre.rms_difference(end, |t| self.centre_of_mass(t)) / self.amplitude()
    }

    /// The error may be as large as the tolerance.
    fn check(&self, centre: &Curve, tolerance: f64) -> ValidationRow {
        let error = self.relative_error(centre);
        ValidationRow::at_most("error of the centre of mass / amplitude", error, tolerance)
    }

    /// P(X, t) = E u'(X, t), the nominal stress; in one dimension that of Cauchy.
    pub fn stress(&self, x: f64, time: f64) -> f64 {
        let omega = self.angular_frequency();
        let strain = self.speed / omega * self.wave_number() * (omega * time).sin() * (self.wave_number() * x).cos();
        self.young_modulus * strain
    }
}

/// The bar of a scene: its only body a box from 0, its velocity a sine.
fn of_scene(scene: &Scene) -> Result<VibratingBar, SceneFault> {
    let (material, _) = solid(scene)?;
    let speed = match scene.bodies.first().and_then(|body| body.velocity.as_ref()) {
        Some(VectorTable::Field(VectorField::Sine { amplitude, .. })) => amplitude.first().copied(),
        _ => None,
    };
    Ok(VibratingBar {
        length: sides(scene)?.first().copied().unwrap_or(f64::NAN),
        young_modulus: material.young_modulus,
        density: material.density,
        speed: speed.unwrap_or(f64::NAN),
    })
}

/// u(X, t) of the bar of a scene.
pub(super) fn displacement(scene: &Scene) -> Option<Displacement> {
    let bar = of_scene(scene).ok()?;
    Some(Box::new(move |start, time| {
        start.iter().map(|&x| bar.displacement(x, time)).collect()
    }))
}

/// The error of the centre of mass over the first period, which may be 0.5 %.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) for a scene that is no bar.
pub(super) fn validate(run: &Run) -> Rows {
    Ok(vec![of_scene(run.scene)?.check(&run.curve("centre_x")?, 0.005)])
}

/// As [`validate`], with the 0.554 % of Cao et al. (2024), §3.1, who have them for displacements of particles, and for every probe at a point the stress of its particle: the error over the first period / amplitude.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) for a scene that is no bar.
pub(super) fn validate_on_mesh(run: &Run) -> Rows {
    let bar = of_scene(run.scene)?;
    let mut rows = vec![bar.check(&run.curve("centre_x")?, 0.00554)];
    for probe in &run.scene.probes {
        let Some(&[at]) = probe.at.as_deref() else { continue };
        let stress = run.curve(&format!("{}_stress_xx", probe.name))?;
        let x = nearest(&run.last.reference_positions, at);
        let amplitude = bar.stress(x, 0.25 * bar.period()).abs();
        let end = bar.period() * (1.0 + 1e-9);
        let error = stress.rms_difference(end, |t| bar.stress(x, t)) / amplitude;
        let name = format!("error of the stress at {} / amplitude", probe.name);
        rows.push(ValidationRow::at_most(&name, error, 0.05));
    }
    Ok(rows)
}

/// The first of the numbers that are nearest to x, which is the particle that a probe follows.
fn nearest(numbers: &[f64], x: f64) -> f64 {
    let distance = |c: &&f64| (*c - x).powi(2);
    let nearest = numbers.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A period of 10.
    fn with_speed(speed: f64) -> VibratingBar {
        VibratingBar {
            length: 25.0,
            young_modulus: 100.0,
            density: 1.0,
            speed,
        }
    }

    #[test]
    fn the_period_is_ten_seconds() {
        assert!((with_speed(0.1).period() - 10.0).abs() < 1e-12);
    }

    #[test]
    fn the_displacement_solves_the_wave_equation_and_the_ends() {
        let bar = with_speed(0.75);
        let step = 1e-3;
        let second = |f: &dyn Fn(f64) -> f64| (f(step) - 2.0 * f(0.0) + f(-step)) / (step * step);
        for (x, t) in [(3.0, 0.7), (12.0, 4.1), (24.0, 9.0)] {
            let acceleration = second(&|dt| bar.displacement(x, t + dt));
            let curvature = second(&|dx| bar.displacement(x + dx, t));
            assert!((bar.density * acceleration - bar.young_modulus * curvature).abs() < 1e-6);
            assert_eq!(bar.displacement(0.0, t), 0.0);
            let end = bar.displacement(bar.length + step, t) - bar.displacement(bar.length - step, t);
            assert!((end / (2.0 * step)).abs() < 1e-12);
        }
        let rate = (bar.displacement(7.0, step) - bar.displacement(7.0, -step)) / (2.0 * step);
        assert!((rate - 0.75 * (bar.wave_number() * 7.0).sin()).abs() < 1e-6);
    }

    #[test]
    fn the_centre_of_mass_is_the_mean_position() {
        let bar = with_speed(0.75);
        let count = 10_000;
        let time = 1.3;
        let positions = (0..count).map(|k| (f64::from(k) + 0.5) / f64::from(count) * bar.length);
        let mean = positions.map(|x| x + bar.displacement(x, time)).sum::<f64>() / f64::from(count);
        assert!((mean - bar.centre_of_mass(time)).abs() < 1e-8);
    }

    #[test]
    fn the_error_of_a_resting_bar_is_one_over_root_two() {
        let bar = with_speed(0.1);
        let mut rest = Curve::default();
        for k in 1..=1000 {
            rest.push(0.01 * f64::from(k), 0.5 * bar.length);
        }
        assert!((bar.relative_error(&rest) - 0.5f64.sqrt()).abs() < 1e-6);
        assert!(!bar.check(&rest, 0.005).passes());
    }
}
