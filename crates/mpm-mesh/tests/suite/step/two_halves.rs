//! Two halves of a square that start against each other (Cao et al. 2024, Appendix D).

use mpm_core::{Apic, Mpm, NoBodyForce, Particles};
use mpm_materials::{ElasticModuli, NeoHookean};
use mpm_mesh::MeshBasis;

use super::conservation::momenta;
use super::{control, solid};
use crate::basis_scenes::cube;

/// Steps here, and those of the paper.
const STEPS: usize = 600;
const ALL_STEPS: usize = 1_000_000;

/// A square of side 0.2 in the middle of the unit square, 20 × 20 particles, E = 10⁴, ν = 0.3, ρ = 1, the halves with velocities (0, ±1),
/// edges of 0.01, APIC, Δt = 10⁻⁵. Over all steps the paper has 10⁻¹⁵ and 10⁻⁷ (of what, it does not say); 10⁻¹⁰ (ours) and 10⁻⁷ are allowed.
#[test]
fn momentum_drifts_no_more_than_rounding() {
    let positions: Vec<[f64; 2]> = (0..400)
        .map(|p| [0.405 + 0.01 * f64::from(p % 20), 0.405 + 0.01 * f64::from(p / 20)])
        .collect();
    let mut particles = Particles::at_rest(positions, 0.04).with_elastic_state(vec![1e-4; 400]);
    for (v, x) in particles.velocities.iter_mut().zip(&particles.positions) {
        v[1] = if x[0] < 0.5 { 1.0 } else { -1.0 };
    }
    let basis = MeshBasis::new(&cube::<2>(100, 0.01, 0.2, 1)).unwrap();
    let law = NeoHookean::new(ElasticModuli::new(1e4, 0.3).unwrap());
    let mut body = Mpm::new(particles, basis, Apic, solid(law), NoBodyForce);
    let (linear, angular) = momenta(&body.particles);
    let share = STEPS as f64 / ALL_STEPS as f64; // rounding grows no faster than the number of steps
    let (mut largest, mut largest_angular) = (0.0, 0.0);
    for _ in 0..STEPS {
        body.step(&control(1e-5)).unwrap();
        let (now, turning) = momenta(&body.particles);
        largest = (0..2)
            .map(|a| (now[a] - linear[a]).abs() / 0.04)
            .fold(largest, f64::max);
        largest_angular = f64::max(largest_angular, (turning.0[0][1] / angular.0[0][1] - 1.0).abs());
    }
    println!("linear {largest:e} of the momentum of both halves, angular {largest_angular:e} of the whole");
    assert!(largest < 1e-10 * share && largest_angular < 1e-7 * share);
}
