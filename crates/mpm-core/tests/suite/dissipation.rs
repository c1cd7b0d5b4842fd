//! What a transfer takes from a shear wave without any force, by the number of steps.

use std::f64::consts::TAU;

use mpm_core::{AffineFlip, Apic, Flip, Mpm, Particles, SplineGrid, Transfer};
use mpm_kernels::Quadratic;
use mpm_materials::IsothermalGas;
use mpm_tensor::Matrix;

use crate::scenes::{Pull, free, strip};

/// The share of kinetic energy that is left after unit time, of a wave six cells long. It is the same along the first axis, so that a strip two cells wide shows all of it.
fn left<T: Transfer<2>>(transfer: T, steps: usize) -> f64 {
    let positions = strip(4, 48);
    let mut particles = Particles::at_rest(positions, 1.0);
    particles.velocities = particles
        .positions
        .iter()
        .map(|x| [1e-4 * (4.0 * TAU * x[1]).sin(), 0.0])
        .collect();
    if T::AFFINE {
        particles.affine = vec![Matrix::ZERO; particles.velocities.len()];
    }
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 1.0 / 24.0).unwrap();
    let still = IsothermalGas::new(1e-12).unwrap();
    let mut mpm = Mpm::new(particles, grid, transfer, still, Pull::none());
    let energy = |velocities: &[[f64; 2]]| velocities.iter().map(|v| v[0] * v[0] + v[1] * v[1]).sum::<f64>();
    let start = energy(&mpm.particles.velocities);
    for _ in 0..steps {
        mpm.step(&free(1.0 / steps as f64)).unwrap();
    }
    energy(&mpm.particles.velocities) / start
}

#[test]
fn a_rate_dissipates_alike_in_few_steps_and_in_many() {
    let relaxing = Flip {
        share: 1.0,
        pic_rate: 2.0,
    };
    let (few, many) = (left(relaxing, 25), left(relaxing, 200));
    assert!(
        (0.4..0.9).contains(&few) && (few / many - 1.0).abs() < 0.05,
        "{few}, {many}"
    );
    let (few, many) = (left(Flip::blend(0.95), 25), left(Flip::blend(0.95), 200));
    assert!(many < 0.2 * few, "{few}, {many}");
}

#[test]
fn affine_particles_lose_nothing_with_a_full_share_of_flip() {
    for steps in [25, 200] {
        let kept = left(AffineFlip::new(Flip::blend(1.0)), steps);
        assert!((kept - 1.0).abs() < 1e-3, "{kept} after {steps} steps");
    }
    let (few, many) = (left(Apic, 25), left(Apic, 200));
    assert!(many < 0.9 * few && few < 1.0, "{few}, {many}");
}
