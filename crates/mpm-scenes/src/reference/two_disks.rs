//! Two elastic disks that collide (Sulsky, Chen & Schreyer 1994): equal, in plane strain, on the diagonal of the unit square, flying at each other with ±(v, v).

use std::f64::consts::PI;

use super::curve::Curve;
use super::parts::{Rows, Run, spacing};
use crate::ValidationRow;

/// ρ.
const DENSITY: f64 = 1000.0;
/// r.
const RADIUS: f64 = 0.2;
/// c, both coordinates of the centre of the lower disk; those of the upper one are 1 − c.
const CENTRE: f64 = 0.2;
/// v.
const SPEED: f64 = 0.1;

/// Share of its initial momentum with which a disk rebounds, for E = 1000 and ν = 0.3: what FLIP runs converge to.
const REBOUND: f64 = 0.92;

/// Kinetic energy before contact per unit thickness, 2 · ½ ρ π r² · 2v².
fn kinetic_energy() -> f64 {
    2.0 * DENSITY * PI * RADIUS.powi(2) * SPEED.powi(2)
}

/// Distance between the rims along the line of the centres, √2 (1 − 2c) − 2r − 2√2 v t, until they meet.
fn gap(time: f64) -> f64 {
    2f64.sqrt() * (1.0 - 2.0 * CENTRE - 2.0 * SPEED * time) - 2.0 * RADIUS
}

/// The first time at which the kinetic energy has changed by the share 10⁻³, which is when the grid begins to transmit force; NaN if it never does.
fn contact(kinetic_energy: &Curve) -> f64 {
    let start = kinetic_energy.first();
    let changed = |&(_, energy): &(f64, f64)| (energy - start).abs() > 1e-3 * start;
    kinetic_energy.points().find(changed).map_or(f64::NAN, |(time, _)| time)
}

/// Rebound of the lower disk, which has the probe `first`, within 0.92 ± 0.02 of its momentum, energy lost at most 5 %, contact at a gap of at most 2h.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let momentum = run.curve("first_velocity_x")?;
    let kinetic = run.curve("kinetic_energy")?;
    let energy = run.curve("strain_energy")?.plus(&kinetic);
    let (rebound, lost) = (momentum.last() / momentum.first(), energy.last() / energy.first());
    let gap = gap(contact(&kinetic)) / spacing(run.scene)?;
    let (start, expected) = (kinetic.first(), kinetic_energy());
    Ok(vec![
        ValidationRow::near("kinetic energy at the start", start, expected, 0.005 * expected),
        ValidationRow::near("rebound momentum / initial", -rebound, REBOUND, 0.02),
        ValidationRow::at_most("energy lost / initial", 1.0 - lost, 0.05),
        ValidationRow::at_most("gap at contact / spacing", gap, 2.0),
    ])
}

/// As [`validate`], with the moments of Cao et al. (2024), §3.2: contact near 1.5 s (ours: ± 0.15 s), the lower disk at rest before 2.0 s, apart
/// before 2.5 s.
///
/// # Errors
/// As [`validate`].
pub(super) fn validate_on_mesh(run: &Run) -> Rows {
    let mut rows = validate(run)?;
    let (kinetic, momentum) = (run.curve("kinetic_energy")?, run.curve("first_velocity_x")?);
    let rest = momentum.crossings(0.0).first().copied().unwrap_or(f64::NAN);
    let (speed, end) = (momentum.peak(), momentum.last());
    let pushed = momentum
        .points()
        .filter(|&(_, velocity)| (velocity - end).abs() > 1e-3 * speed);
    let apart = pushed.last().map_or(f64::NAN, |(time, _)| time);
    rows.push(ValidationRow::near("time of contact", contact(&kinetic), 1.5, 0.15));
    rows.push(ValidationRow::at_most("time of rest", rest, 2.0));
    rows.push(ValidationRow::at_most("time of separation", apart, 2.5));
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_and_contact_time_are_those_of_the_literature() {
        assert!((kinetic_energy() - 2.513).abs() < 5e-4);
        assert!(gap(1.5855) > 0.0 && gap(1.5865) < 0.0);
    }

    #[test]
    fn contact_is_where_the_kinetic_energy_leaves_its_start() {
        let mut energy = Curve::default();
        for k in 0..300 {
            let t = 0.01 * f64::from(k);
            energy.push(t, if t < 1.5 { 2.5 } else { 2.4 });
        }
        assert!((contact(&energy) - 1.5).abs() < 1e-12);
        energy.values.fill(1.0);
        assert!(contact(&energy).is_nan());
    }
}
