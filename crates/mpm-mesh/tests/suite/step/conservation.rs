//! Momentum, angular momentum with affine transfers, and the same bits on any number of threads.

use crate::basis_scenes::{cloud, cube, generator};
use mpm_core::{Apic, Basis, Flip, Masses, Mls, Mpm, NoBodyForce, Particles, Transfer};
use mpm_materials::{ElasticModuli, NeoHookean};
use mpm_mesh::{Gradient, MeshBasis};
use mpm_tensor::Matrix;
use proptest::prelude::*;
use rand::RngExt;

use super::{Solid, control, solid};

type Body<const D: usize, T> = Mpm<D, MeshBasis<D>, T, Solid<D>, NoBodyForce>;

/// A cloud of different masses and velocities in the middle of a mesh of cubes of edge 0.3.
fn body<const D: usize, T: Transfer<D>>(cells: usize, count: usize, low: f64, seed: u64, transfer: T) -> Body<D, T> {
    let mesh = cube::<D>(cells, 0.3, 0.15, seed);
    let edge = 0.3 * cells as f64;
    let mut random = generator(seed);
    let positions = cloud::<D>(count, low, edge - low, seed + 1);
    let mut particles = Particles::at_rest(positions, 1.0).with_elastic_state(vec![1.0 / count as f64; count]);
    particles.velocities = (0..count)
        .map(|_| std::array::from_fn(|_| random.random_range(-1.0..1.0)))
        .collect();
    particles.masses = Masses::Each(
        (0..count)
            .map(|_| random.random_range(0.5..1.5) / count as f64)
            .collect(),
    );
    let medium = solid(NeoHookean::new(ElasticModuli::new(2.0, 0.3).unwrap()));
    Mpm::new(particles, MeshBasis::new(&mesh).unwrap(), transfer, medium, NoBodyForce)
}

/// Σ m v, and Σ m (x_a v_b − x_b v_a + B_ba − B_ab).
pub fn momenta<const D: usize>(particles: &Particles<D>) -> ([f64; D], Matrix<D>) {
    let (mut linear, mut angular) = ([0.0; D], Matrix::ZERO);
    for p in 0..particles.len() {
        let (m, x, v) = (particles.masses.get(p), particles.positions[p], particles.velocities[p]);
        let affine = particles.affine.get(p).copied().unwrap_or(Matrix::ZERO);
        angular += (Matrix::outer(&x, &v) - Matrix::outer(&v, &x) + affine.transpose() - affine) * m;
        (0..D).for_each(|a| linear[a] += m * v[a]);
    }
    (linear, angular)
}

fn conserves<const D: usize, T: Transfer<D>>(cells: usize, low: f64, seed: u64, name: &str, transfer: T) {
    let mut body = body::<D, T>(cells, 40, low, seed, transfer);
    body.basis = body.basis.with_positive_weights(seed % 2 == 1);
    if seed / 2 % 2 == 1 {
        body.basis = body.basis.with_gradient(Gradient::Exact);
    }
    let (linear, angular) = momenta(&body.particles);
    for _ in 0..4 {
        body.step(&control(1e-4)).unwrap();
    }
    let (linear_after, angular_after) = momenta(&body.particles);
    let largest = body
        .particles
        .velocities
        .iter()
        .flatten()
        .fold(1.0, |most: f64, c| most.max(c.abs()));
    for a in 0..D {
        let change = linear_after[a] - linear[a];
        assert!(
            change.abs() < 1e-12 * largest,
            "{name}, D = {D}: momentum off by {change}"
        );
    }
    let change = (angular_after - angular).maximum_norm();
    assert!(
        !T::AFFINE || change < 1e-11 * largest,
        "{name}, D = {D}: angular momentum off by {change}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn momentum_is_conserved(seed in 0u64..1_000_000) {
        conserves::<1, _>(12, 0.6, seed, "FLIP", Flip::blend(0.95));
        conserves::<2, _>(8, 0.6, seed, "FLIP", Flip::blend(0.95));
        conserves::<2, _>(8, 0.6, seed, "APIC", Apic);
        conserves::<2, _>(8, 0.6, seed, "MLS", Mls);
        conserves::<3, _>(5, 0.4, seed, "APIC", Apic);
    }
}

/// All state after some steps, as bits.
fn run<const D: usize, T: Transfer<D>>(cells: usize, count: usize, positive: bool, transfer: T) -> Vec<u64> {
    let mut body = body::<D, T>(cells, count, 0.6, 5, transfer);
    body.basis = body.basis.with_positive_weights(positive);
    for _ in 0..2 {
        body.step(&control(2e-3)).unwrap();
    }
    assert!(
        body.basis.schedule().parts().len() > 1,
        "too small a scene for the parallel paths"
    );
    let p = &body.particles;
    let identities = (0..p.len()).map(|k| p.identity(k) as u64);
    let vectors = p.positions.iter().chain(&p.velocities).flatten();
    let matrices = p
        .affine
        .iter()
        .chain(&p.deformation_gradients)
        .flat_map(|m| m.0.iter().flatten());
    identities.chain(vectors.chain(matrices).map(|c| c.to_bits())).collect()
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    fn check(what: &str, scene: impl Fn() -> Vec<u64> + Sync) {
        let on = |threads: usize| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap()
                .install(&scene)
        };
        let one = on(1);
        for threads in [2, 3] {
            assert!(one == on(threads), "{what}: {threads} threads give other bits than one");
        }
    }
    check("FLIP, D = 1", || run::<1, _>(400, 20_000, false, Flip::blend(0.95)));
    check("APIC, D = 2", || run::<2, _>(30, 10_000, false, Apic));
    check("FLIP, D = 2", || run::<2, _>(30, 10_000, false, Flip::blend(0.95)));
    check("APIC, D = 3", || run::<3, _>(8, 6_000, false, Apic));
    check("APIC, D = 3, positive weights", || run::<3, _>(8, 6_000, true, Apic));
}
