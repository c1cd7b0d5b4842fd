//! The same bits on one, two and three threads.

use mpm_core::{Apic, Basis, Flip, Medium, Mpm, Particles, Pic, SplineGrid, Transfer};
use mpm_kernels::{Cubic, Quadratic, Spline};
use mpm_materials::IsothermalGas;

use crate::scenes::{Pull, bits, free, gaussian_cloud, matrix_bits, neo_hookean};

const STEPS: usize = 20;

/// Stencil visits above which one colour, or one share of the particles, is given to several threads.
const PARALLEL_THRESHOLD: usize = 1 << 14;

/// All state after the steps, as bits.
fn run<S: Spline<W>, T: Transfer<D>, M: Medium<D>, const W: usize, const D: usize>(
    count: usize,
    h: f64,
    transfer: T,
    medium: M,
    body_force: Pull<D>,
) -> Vec<u64> {
    let mut particles = Particles::at_rest(gaussian_cloud::<D>(count, 3), 1.0);
    if M::DEFORMS {
        particles = particles.with_elastic_state(vec![1.0 / count as f64; count]);
    }
    let grid = SplineGrid::<S, W, D>::new([0.0; D], h).unwrap();
    let mut mpm = Mpm::new(particles, grid, transfer, medium, body_force);
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
    let schedule = mpm.basis.schedule();
    let busy = schedule.colours().any(|groups| {
        let particles: usize = groups.iter().map(|&g| schedule.group_particles(g as usize).len()).sum();
        groups.len() > 1 && particles * W.pow(D as u32) > PARALLEL_THRESHOLD
    });
    assert!(busy, "too small a scene for the parallel paths");
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

fn gas() -> IsothermalGas {
    IsothermalGas::CALIBRATED
}

#[test]
fn pic() {
    same_on_any_pool("D = 1", || {
        run::<Quadratic, _, _, 3, 1>(40_000, 0.001, Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 2", || {
        run::<Quadratic, _, _, 3, 2>(16_000, 0.06, Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 2, nodes", || {
        run::<Cubic, _, _, 4, 2>(16_000, 0.06, Pic, gas(), nodal_well())
    });
    same_on_any_pool("D = 3", || {
        run::<Quadratic, _, _, 3, 3>(10_000, 0.2, Pic, gas(), Pull::well())
    });
    same_on_any_pool("D = 6", || {
        run::<Quadratic, _, _, 3, 6>(2_500, 1.0, Pic, gas(), Pull::well())
    });
}

#[test]
fn apic() {
    same_on_any_pool("gas", || {
        run::<Quadratic, _, _, 3, 2>(16_000, 0.06, Apic, gas(), Pull::well())
    });
    same_on_any_pool("solid", || {
        run::<Quadratic, _, _, 3, 3>(8_000, 0.25, Apic, neo_hookean(0.5), Pull::well())
    });
}

#[test]
fn flip() {
    let flip = Flip { share: 0.95 };
    same_on_any_pool("gas", || {
        run::<Quadratic, _, _, 3, 2>(16_000, 0.06, flip, gas(), Pull::well())
    });
    same_on_any_pool("solid", || {
        run::<Quadratic, _, _, 3, 3>(8_000, 0.25, flip, neo_hookean(0.5), nodal_well())
    });
}
