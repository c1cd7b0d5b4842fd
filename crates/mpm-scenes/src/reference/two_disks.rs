//! Two elastic disks that collide (Sulsky, Chen & Schreyer 1994).

use std::f64::consts::PI;

use super::curve::Curve;
use super::parts::{Rows, Run, spacing};
use crate::ValidationRow;

/// Two equal disks in plane strain on the diagonal of the unit square, flying at each other with ±(v, v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoDisks {
    /// ρ.
    pub density: f64,
    /// r.
    pub radius: f64,
    /// Both coordinates of the centre of the lower disk; those of the upper one are 1 minus it.
    pub centre: f64,
    /// v.
    pub speed: f64,
}

/// Share of its initial momentum with which a disk rebounds, for E = 1000 and ν = 0.3: what FLIP runs converge to.
pub const REBOUND: f64 = 0.92;

impl Default for TwoDisks {
    /// ρ = 1000, r = 0.2, centres (0.2, 0.2) and (0.8, 0.8), v = 0.1.
    fn default() -> Self {
        Self {
            density: 1000.0,
            radius: 0.2,
            centre: 0.2,
            speed: 0.1,
        }
    }
}

impl TwoDisks {
    /// Kinetic energy before contact per unit thickness, 2 · ½ ρ π r² · 2v².
    pub fn kinetic_energy(&self) -> f64 {
        2.0 * self.density * PI * self.radius.powi(2) * self.speed.powi(2)
    }

    /// Distance between the rims along the line of the centres, √2 (1 − 2c) − 2r − 2√2 v t, until they meet.
    pub fn gap(&self, time: f64) -> f64 {
        2f64.sqrt() * (1.0 - 2.0 * self.centre - 2.0 * self.speed * time) - 2.0 * self.radius
    }

    /// The time at which the rims meet, ((1 − 2c) − √2 r) / 2v.
    pub fn contact_time(&self) -> f64 {
        self.gap(0.0) / (2.0 * 2f64.sqrt() * self.speed)
    }

    /// The gap at which a grid begins to transmit force: that of the last time before the kinetic energy has changed by the
    /// share 10⁻³. `None` if it never does.
    pub fn gap_at_contact(&self, kinetic_energy: &Curve) -> Option<f64> {
        Self::contact(kinetic_energy).map(|time| self.gap(time))
    }

    /// The first time at which the kinetic energy has changed by the share 10⁻³.
    fn contact(kinetic_energy: &Curve) -> Option<f64> {
        let start = kinetic_energy.first();
        let changed = |&(_, energy): &(f64, f64)| (energy - start).abs() > 1e-3 * start;
        kinetic_energy.points().find(changed).map(|(time, _)| time)
    }

    /// Rebound within 0.92 ± 0.02 of the initial momentum, energy lost at most 5 %, contact at a gap of at most 2h.
    ///
    /// `momentum`: of the lower disk along x over that at the start. `energy`: kinetic and strain energy together.
    pub fn checks(&self, momentum: &Curve, kinetic_energy: &Curve, energy: &Curve, spacing: f64) -> Vec<ValidationRow> {
        let gap = self.gap_at_contact(kinetic_energy).unwrap_or(f64::NAN);
        vec![
            ValidationRow::near(
                "kinetic energy at the start",
                kinetic_energy.first(),
                self.kinetic_energy(),
                0.005 * self.kinetic_energy(),
            ),
            ValidationRow::near("rebound momentum / initial", -momentum.last(), REBOUND, 0.02),
            ValidationRow::at_most("energy lost / initial", 1.0 - energy.last() / energy.first(), 0.05),
            ValidationRow::at_most("gap at contact / spacing", gap / spacing, 2.0),
        ]
    }
}

/// The checks of a scene with the probe `first` on the lower disk.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let mut momentum = run.curve("first_velocity_x")?;
    let kinetic = run.curve("kinetic_energy")?;
    let energy = run.curve("strain_energy")?.plus(&kinetic);
    let start = momentum.first();
    momentum.values.iter_mut().for_each(|value| *value /= start);
    Ok(TwoDisks::default().checks(&momentum, &kinetic, &energy, spacing(run.scene)?))
}

/// As [`validate`], with the moments of Cao et al. (2024), §3.2: contact near 1.5 s (ours: ± 0.15 s), the lower disk at rest before 2.0 s, apart
/// before 2.5 s.
///
/// # Errors
/// As [`validate`].
pub(super) fn validate_on_mesh(run: &Run) -> Rows {
    let mut rows = validate(run)?;
    let (kinetic, momentum) = (run.curve("kinetic_energy")?, run.curve("first_velocity_x")?);
    let contact = TwoDisks::contact(&kinetic).unwrap_or(f64::NAN);
    let rest = momentum.crossings(0.0).first().copied().unwrap_or(f64::NAN);
    let (speed, end) = (momentum.peak(), momentum.last());
    let pushed = momentum
        .points()
        .filter(|&(_, velocity)| (velocity - end).abs() > 1e-3 * speed);
    let apart = pushed.last().map_or(f64::NAN, |(time, _)| time);
    rows.push(ValidationRow::near("time of contact", contact, 1.5, 0.15));
    rows.push(ValidationRow::at_most("time of rest", rest, 2.0));
    rows.push(ValidationRow::at_most("time of separation", apart, 2.5));
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_and_contact_time_are_those_of_the_literature() {
        let disks = TwoDisks::default();
        assert!((disks.kinetic_energy() - 2.513).abs() < 5e-4);
        assert!((disks.contact_time() - 1.586).abs() < 5e-4);
        assert!(disks.gap(disks.contact_time()).abs() < 1e-15);
    }

    #[test]
    fn contact_is_where_the_kinetic_energy_leaves_its_start() {
        let disks = TwoDisks::default();
        let mut energy = Curve::default();
        for k in 0..300 {
            let t = 0.01 * f64::from(k);
            energy.push(t, if t < 1.5 { 2.5 } else { 2.4 });
        }
        let gap = disks.gap_at_contact(&energy).expect("touches");
        assert!((gap - disks.gap(1.5)).abs() < 1e-12);
        energy.values.fill(1.0);
        assert_eq!(disks.gap_at_contact(&energy), None);
    }
}
