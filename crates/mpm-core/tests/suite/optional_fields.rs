//! What a scene does not use does not exist.

use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

use mpm_core::{Apic, BodyForce, Flip, ForceLocation, Medium, Mpm, Particles, Pic, SplineGrid, Transfer};
use mpm_kernels::Quadratic;
use mpm_materials::IsothermalGas;

use crate::scenes::{Pull, free, gaussian_cloud, neo_hookean};

/// Capacities of the fields B, F, V⁰ after a few steps, and the bytes per particle beside the basis.
fn after_steps<T: Transfer<2>, M: Medium<2, State = ()>>(
    transfer: T,
    medium: M,
    force: Pull<2>,
) -> ([usize; 3], usize) {
    let mut particles = Particles::at_rest(gaussian_cloud(1000, 1), 1.0);
    if M::DEFORMS {
        particles = particles.with_elastic_state(vec![0.1; 1000]);
    }
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.5).unwrap();
    let mut mpm = Mpm::new(particles, grid, transfer, medium, force);
    for _ in 0..3 {
        mpm.step(&free(1e-3)).unwrap();
    }
    let p = &mpm.particles;
    let capacities = [
        p.affine.capacity(),
        p.deformation_gradients.capacity(),
        p.reference_volumes.capacity(),
    ];
    (capacities, p.storage_bytes() / 1000)
}

#[test]
fn fields_without_use_have_no_capacity() {
    let gas = IsothermalGas::CALIBRATED;
    let solid = neo_hookean(1.0);
    // Positions, velocities, a buffer (16 bytes each), identities and their buffer (4 each).
    assert_eq!(after_steps(Pic, gas, Pull::none()), ([0; 3], 56));
    assert_eq!(
        after_steps(Flip::blend(0.9), gas, Pull::at_particles(|_| [0.0; 2])),
        ([0; 3], 56)
    );
    assert_eq!(after_steps(Pic, gas, Pull::at_nodes(|_, _| [0.0; 2])), ([0; 3], 56));
    // B and a buffer: 32 bytes each.
    assert_eq!(after_steps(Apic, gas, Pull::none()), ([1000, 0, 0], 120));
    // F, V⁰ and their buffers.
    assert_eq!(after_steps(Pic, solid, Pull::none()), ([0, 1000, 1000], 136));
    assert_eq!(after_steps(Apic, solid, Pull::none()), ([1000; 3], 168));
}

#[test]
fn a_body_force_is_asked_only_where_it_acts() {
    struct Counting<'a> {
        particles: &'a AtomicUsize,
        nodes: &'a AtomicUsize,
    }
    impl BodyForce<3> for Counting<'_> {
        fn location(&self) -> ForceLocation {
            ForceLocation::Nodes
        }
        fn at_particles(&mut self, _: &mpm_core::Sites<3>, _: &mut [[f64; 3]]) -> Result<(), mpm_core::MpmError> {
            self.particles.fetch_add(1, Relaxed);
            Ok(())
        }
        fn at_nodes(
            &mut self,
            positions: &[[f64; 3]],
            masses: &dyn Fn(usize) -> f64,
            forces: &mut [[f64; 3]],
        ) -> Result<(), mpm_core::MpmError> {
            self.nodes.fetch_add(1, Relaxed);
            assert_eq!(positions.len(), forces.len());
            let total: f64 = (0..positions.len()).map(masses).sum();
            assert!((total - 1.0).abs() < 1e-13, "masses of the nodes sum to {total}");
            forces.fill([0.0; 3]);
            Ok(())
        }
    }
    let grid = SplineGrid::<Quadratic, 3, 3>::new([0.0; 3], 0.5).unwrap();
    let particles = Particles::at_rest(gaussian_cloud(100, 1), 1.0);
    let [of_particles, of_nodes] = [const { AtomicUsize::new(0) }; 2];
    let counting = Counting {
        particles: &of_particles,
        nodes: &of_nodes,
    };
    let mut mpm = Mpm::new(particles, grid, Pic, IsothermalGas::CALIBRATED, Pull::by(counting));
    mpm.step(&free(0.01)).unwrap();
    mpm.step(&free(0.01)).unwrap();
    assert_eq!((of_particles.load(Relaxed), of_nodes.load(Relaxed)), (0, 2));
}

#[test]
fn fields_come_back_in_the_order_of_creation() {
    let positions = gaussian_cloud::<3>(500, 2);
    let grid = SplineGrid::<Quadratic, 3, 3>::new([0.0; 3], 0.5).unwrap();
    let mut mpm = Mpm::new(
        Particles::at_rest(positions.clone(), 1.0),
        grid,
        Pic,
        IsothermalGas::CALIBRATED,
        Pull::none(),
    );
    mpm.step(&free(1e-9)).unwrap();
    let p = &mpm.particles;
    let sorted = p.in_creation_order(&p.positions);
    for (before, after) in positions.iter().zip(&sorted) {
        assert!(crate::scenes::distance(before, after) < 1e-6);
    }
    assert!(p.positions != sorted, "a step sorts by cell");
    assert!(p.in_creation_order(&p.affine).is_empty());
}
