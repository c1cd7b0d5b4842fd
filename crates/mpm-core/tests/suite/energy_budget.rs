//! What the energy budget says is what particles store.

use mpm_core::{AffineFlip, Apic, Basis, EnergyBudget, Flip, Mls, Mpm, Particles, SplineGrid, Transfer};
use mpm_kernels::Quadratic;
use mpm_materials::Law;

use crate::scenes::{Pull, free, neo_hookean, uniform_cloud};

/// Σ V⁰ψ changes by what forces have not given to the nodes and the integration in time has not taken, to rounding, in steps of which forces alone miss several percent.
fn strain_is_accounted_for<const D: usize, B: Basis<D>, T: Transfer<D>>(name: &str, basis: B, transfer: T) {
    let count = 60;
    let mut particles = Particles::at_rest(uniform_cloud::<D>(count, 1.0, 8), 1.0);
    let velocity = |x: &[f64; D]| std::array::from_fn(|a| (3.0 * x[(a + 1) % D] + a as f64).sin() - x[a]);
    particles.velocities = particles.positions.iter().map(velocity).collect();
    let particles = particles.with_elastic_state(vec![1.0 / count as f64; count]);
    let mut body = Mpm::new(particles, basis, transfer, neo_hookean(20.0), Pull::none());
    body.energy_budget = Some(EnergyBudget::default());
    for _ in 0..6 {
        body.step(&free(0.01)).unwrap();
    }
    let (law, particles) = (&body.medium.0.law, &body.particles);
    let each = particles.deformation_gradients.iter().zip(&particles.reference_volumes);
    let stored: f64 = each
        .map(|(deformation, volume)| volume * law.energy_density(deformation, &()))
        .sum();
    let budget = body.energy_budget.unwrap();
    let left = stored + budget.forces;
    assert!(
        stored > 1e-3 && left.abs() > 0.01 * stored,
        "{name}: {left} of {stored}"
    );
    let left = left + budget.time_integration;
    assert!(left.abs() < 1e-12 * stored, "{name}: {left} of {stored}");
}

fn with_apic<const D: usize, B: Basis<D>>(name: &str, make: impl Fn([f64; D], f64) -> B) {
    strain_is_accounted_for(name, make([0.0; D], 0.3), Apic);
}

#[test]
fn strain_is_accounted_for_on_every_basis() {
    every_basis!(with_apic, 2);
}

#[test]
fn strain_is_accounted_for_with_every_transfer() {
    let basis = || SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.3).unwrap();
    strain_is_accounted_for("MLS", basis(), Mls);
    strain_is_accounted_for("FLIP", basis(), Flip::blend(0.9));
    strain_is_accounted_for("affine FLIP", basis(), AffineFlip::new(Flip::blend(1.0)));
}
