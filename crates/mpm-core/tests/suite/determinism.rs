//! The same bits on one, two and three threads, and of a body that goes on from its fields.

use mpm_core::{Apic, Flip, Medium, Mpm, Particles, Pic, SimplexLattice, SplineGrid, Transfer, UniformBasis};
use mpm_kernels::{Cubic, Quadratic, Spline};
use mpm_materials::IsothermalGas;

use crate::scenes::{Pull, bits, free, gaussian_cloud, matrix_bits, neo_hookean};

/// Every one sorts anew and goes through all tables: what depends on threads shows in two.
const STEPS: usize = 2;

/// All state after the steps, as bits.
fn run<B: UniformBasis<D>, T: Transfer<D>, M: Medium<D, State = ()>, const D: usize>(
    count: usize,
    basis: B,
    transfer: T,
    medium: M,
    body_force: Pull<D>,
) -> Vec<u64> {
    let mut particles = Particles::at_rest(gaussian_cloud::<D>(count, 3), 1.0);
    if M::DEFORMS {
        particles = particles.with_elastic_state(vec![1.0 / count as f64; count]);
    }
    let h = basis.spacing();
    let mut mpm = Mpm::new(particles, basis, transfer, medium, body_force);
    let mut control = free(0.1 * h);
    (control.displacement, control.friction) = (0.3, 0.5);
    let mut state = Vec::new();
    for step in 0..STEPS {
        mpm.basis.place([0.618 * h * step as f64; D], h).unwrap();
        let report = mpm.step(&control).unwrap();
        state.extend([
            report.active_nodes as u64,
            report.displacement.to_bits(),
            report.time_step.to_bits(),
        ]);
    }
    assert!(
        mpm.basis.schedule().parts().len() > 1,
        "too small a scene for the parallel paths"
    );
    let p = &mpm.particles;
    state.extend((0..p.len()).map(|k| p.identity(k) as u64));
    state.extend(bits(&p.positions));
    state.extend(bits(&p.velocities));
    state.extend(matrix_bits(&p.affine));
    state.extend(matrix_bits(&p.deformation_gradients));
    state
}

/// The same scene on pools of different sizes.
fn same_on_any_pool(what: &str, scene: impl Fn() -> Vec<u64> + Sync) {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(&scene)
    };
    let one = on(1);
    for threads in [2, 3] {
        assert!(one == on(threads), "{what}: {threads} threads give other bits than one");
    }
}

/// m times the score of N(0, I), at the nodes.
fn nodal_well<const D: usize>() -> Pull<'static, D> {
    Pull::at_nodes(|x, mass| x.map(|c| -c * mass))
}

fn grid<S: Spline<W>, const W: usize, const D: usize>(h: f64) -> SplineGrid<S, W, D> {
    SplineGrid::new([0.0; D], h).unwrap()
}

fn lattice<const D: usize>(h: f64) -> SimplexLattice<D> {
    SimplexLattice::permutohedral([0.0; D], h).unwrap()
}

fn gas() -> IsothermalGas {
    IsothermalGas::CALIBRATED
}

#[test]
fn pic() {
    same_on_any_pool("D = 1", || {
        run(40_000, grid::<Quadratic, 3, 1>(0.001), Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 2", || {
        run(16_000, grid::<Quadratic, 3, 2>(0.06), Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 2, nodes", || {
        run(8_200, grid::<Cubic, 4, 2>(0.06), Pic, gas(), nodal_well())
    });
    same_on_any_pool("D = 3", || {
        run(5_000, grid::<Quadratic, 3, 3>(0.2), Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 6", || {
        run(200, grid::<Quadratic, 3, 6>(1.0), Pic, gas(), Pull::well())
    });
}

#[test]
fn apic() {
    same_on_any_pool("gas", || {
        run(16_000, grid::<Quadratic, 3, 2>(0.06), Apic, gas(), Pull::well())
    });
    same_on_any_pool("solid", || {
        run(
            5_000,
            grid::<Quadratic, 3, 3>(0.25),
            Apic,
            neo_hookean(0.5),
            Pull::well(),
        )
    });
}

#[test]
fn flip() {
    let flip = Flip::blend(0.95);
    same_on_any_pool("gas", || {
        run(16_000, grid::<Quadratic, 3, 2>(0.06), flip, gas(), Pull::well())
    });
    same_on_any_pool("solid", || {
        run(
            16_000,
            grid::<Quadratic, 3, 2>(0.06),
            flip,
            neo_hookean(0.5),
            nodal_well(),
        )
    });
}

#[test]
fn lattice_in_all_its_tables() {
    same_on_any_pool("D = 1", || run(60_000, lattice::<1>(0.01), Pic, gas(), Pull::well()));
    same_on_any_pool("D = 2", || run(40_000, lattice::<2>(0.1), Pic, gas(), Pull::well()));
    same_on_any_pool("D = 3", || {
        run(20_000, lattice::<3>(0.3), Apic, neo_hookean(0.5), Pull::well())
    });
    same_on_any_pool("D = 6, hashed", || {
        run(12_000, lattice::<6>(0.5), Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 8, hashed by coordinates", || {
        run(9_000, lattice::<8>(0.05), Pic, gas(), Pull::well())
    });
    let flip = Flip::blend(0.95);
    same_on_any_pool("FLIP", || {
        run(20_000, lattice::<3>(0.3), flip, neo_hookean(0.5), nodal_well())
    });
}

/// The places after twenty steps, of a body that is made again from its fields after `kept` of them (0: not).
fn made_again<B: UniformBasis<2>>(make: impl Fn() -> B, kept: usize) -> Vec<u64> {
    let particles = Particles::at_rest(gaussian_cloud::<2>(2_000, 3), 1.0);
    let mut mpm = Mpm::new(particles, make(), Apic, gas(), Pull::well());
    for step in 0..20 {
        if kept > 0 && step == kept {
            let p = &mpm.particles;
            let particles = Particles::in_order(
                p.positions.clone(),
                p.velocities.clone(),
                p.masses.clone(),
                p.affine.clone(),
                p.identities().to_vec(),
            );
            let time = mpm.time;
            mpm = Mpm::new(particles.unwrap(), make(), Apic, gas(), Pull::well());
            mpm.time = time;
        }
        mpm.step(&free(0.02)).unwrap();
    }
    bits(&mpm.particles.positions)
}

#[test]
fn a_body_goes_on_from_its_fields() {
    let splines = || grid::<Quadratic, 3, 2>(0.1);
    assert!(made_again(splines, 3) == made_again(splines, 0));
    for kept in [8, 16] {
        assert!(
            made_again(|| lattice(0.1), kept) == made_again(|| lattice(0.1), 0),
            "{kept}"
        );
    }
}
