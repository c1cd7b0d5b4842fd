//! What a velocity filter forgets, and what it keeps.

use std::f64::consts::TAU;

use mpm_core::{Basis, Flip, Mpm, MpmError, Particles, SimplexLattice, SplineGrid, UniformBasis, VelocityFilter};
use mpm_kernels::{Cubic, Linear, Quadratic};
use mpm_materials::IsothermalGas;
use proptest::prelude::*;

use crate::scenes::{Pull, bits, free, gaussian_cloud, strip, uniform_cloud};

/// rτ of a filter in these tests.
const EXPONENT: f64 = 0.7;

/// Velocities before and after one filter, and the positions, all in the order of the schedule. Nothing else acts.
fn filtered<B: Basis<D>, const D: usize>(
    basis: B,
    particles: Particles<D>,
    order: usize,
) -> (Mpm<D, B, Flip, IsothermalGas, Pull<'static, D>>, Vec<[f64; D]>) {
    let still = IsothermalGas::new(1e-300).unwrap();
    let mut mpm = Mpm::new(particles, basis, Flip::blend(1.0), still, Pull::none());
    let step = 1e-12; // nothing moves
    mpm.step(&free(step)).unwrap();
    let before = mpm.particles.in_creation_order(&mpm.particles.velocities);
    mpm.velocity_filter = Some(VelocityFilter::new(order, EXPONENT / step).unwrap());
    mpm.step(&free(step)).unwrap();
    (mpm, before)
}

fn cloud<const D: usize>(count: usize) -> Particles<D> {
    let mut particles = Particles::at_rest(uniform_cloud(count, 1.0, 5), 1.0);
    particles.velocities = gaussian_cloud(count, 6);
    particles
}

/// 1 − 𝒫 by sums over all pairs of particles, through the stencils alone.
fn naive<B: Basis<D>, const D: usize>(basis: &B, positions: &[[f64; D]], field: &[[f64; D]]) -> Vec<[f64; D]> {
    let mut stencils = vec![std::collections::BTreeMap::new(); positions.len()];
    let mut scratch = Vec::new();
    let schedule = basis.schedule();
    for cell in 0..schedule.cell_count() {
        let nodes = basis.cell_nodes(cell, &mut scratch).to_vec();
        for p in schedule.cell(cell) {
            basis.for_each_node(p, &positions[p], |index, entry| {
                if entry.weight > 0.0 {
                    stencils[p].insert(nodes[index], entry.weight);
                }
            });
        }
    }
    let mut masses = vec![0.0; basis.node_count()];
    for (node, weight) in stencils.iter().flatten() {
        masses[*node as usize] += weight;
    }
    let share = |p: usize, q: usize| -> f64 {
        let common = |(node, weight): (&u32, &f64)| Some(weight * stencils[q].get(node)? / masses[*node as usize]);
        stencils[p].iter().filter_map(common).sum()
    };
    let unseen = |p: usize| {
        let mut left = field[p];
        for (q, v) in field.iter().enumerate() {
            let share = share(p, q);
            for a in 0..D {
                left[a] -= share * v[a];
            }
        }
        left
    };
    (0..field.len()).map(unseen).collect()
}

fn is_the_formula<const D: usize, B: UniformBasis<D>>(name: &str, make: fn([f64; D], f64) -> B) {
    for order in [1, 2, 5] {
        let (mpm, before) = filtered(make([0.1; D], 0.3), cloud(60), order);
        let place = |k: usize| mpm.particles.identity(k);
        let start: Vec<[f64; D]> = (0..mpm.particles.len()).map(|k| before[place(k)]).collect();
        let mut unseen = start.clone();
        for _ in 0..order {
            unseen = naive(&mpm.basis, &mpm.particles.positions, &unseen);
        }
        for (p, v) in mpm.particles.velocities.iter().enumerate() {
            for a in 0..D {
                let expected = start[p][a] - (1.0 - (-EXPONENT).exp()) * unseen[p][a];
                assert!(
                    (v[a] - expected).abs() < 1e-11,
                    "{name}, order {order}: {} for {expected}",
                    v[a]
                );
            }
        }
    }
}

/// It sees of a basis what it sends and receives, which the conformance of bases holds to the stencil: not every one is filtered.
#[test]
fn a_filter_is_its_formula() {
    is_the_formula::<1, _>("quadratic", |o, h| SplineGrid::<Quadratic, 3, 1>::new(o, h).unwrap());
    is_the_formula::<2, _>("linear", |o, h| SplineGrid::<Linear, 2, 2>::new(o, h).unwrap());
    is_the_formula::<2, _>("quadratic", |o, h| SplineGrid::<Quadratic, 3, 2>::new(o, h).unwrap());
    is_the_formula::<2, _>("cubic", |o, h| SplineGrid::<Cubic, 4, 2>::new(o, h).unwrap());
    is_the_formula::<2, _>("lattice", |o, h| SimplexLattice::<2>::permutohedral(o, h).unwrap());
    is_the_formula::<3, _>("quadratic", |o, h| SplineGrid::<Quadratic, 3, 3>::new(o, h).unwrap());
}

proptest! {
    #[test]
    fn momentum_stays_and_energy_does_not_grow(
        order in 1_usize..12,
        spacing in 0.05_f64..1.5,
        masses in prop::collection::vec(0.01_f64..10.0, 40),
    ) {
        let mut particles = cloud::<2>(masses.len());
        particles.masses = mpm_core::Masses::Each(masses);
        let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], spacing).unwrap();
        let (mpm, before) = filtered(grid, particles, order);
        let after = &mpm.particles;
        let sums = |velocity: &dyn Fn(usize) -> [f64; 2]| {
            (0..after.len()).fold([0.0; 3], |sum, k| {
                let (m, v) = (after.masses.get(k), velocity(k));
                [sum[0] + m * v[0], sum[1] + m * v[1], sum[2] + m * (v[0] * v[0] + v[1] * v[1])]
            })
        };
        let start = sums(&|k| before[after.identity(k)]);
        let end = sums(&|k| after.velocities[k]);
        let scale = start[2].max(1.0);
        prop_assert!((start[0] - end[0]).abs() < 1e-12 * scale && (start[1] - end[1]).abs() < 1e-12 * scale);
        prop_assert!(end[2] <= start[2] * (1.0 + 1e-12), "{} from {}", end[2], start[2]);
    }
}

/// In 1 / time; not a multiple of a tenth, which a sum of time steps may miss by rounding.
const RATE: f64 = 2.02;

/// The shares that are left of a wave six cells long and of velocities that alternate within a cell, after unit time. The wave is the same along the first axis, so that a strip shows all of it.
fn left(order: usize, steps: usize) -> [f64; 2] {
    const ALONG: usize = 16;
    const ACROSS: usize = 48;
    let positions = strip(ALONG, ACROSS);
    let rows: Vec<f64> = positions.iter().map(|x| x[1]).collect();
    let wave = |k: usize| (4.0 * TAU * rows[k]).sin();
    let noise = |k: usize| {
        if (k % ALONG + k / ALONG).is_multiple_of(2) {
            1.0
        } else {
            -1.0
        }
    };
    let mut particles = Particles::at_rest(positions, 1.0);
    particles.velocities = (0..ALONG * ACROSS).map(|k| [1e-6 * wave(k), 1e-6 * noise(k)]).collect();
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 1.0 / 24.0).unwrap();
    let mut mpm = Mpm::new(
        particles,
        grid,
        Flip::blend(1.0),
        IsothermalGas::new(1e-15).unwrap(),
        Pull::none(),
    );
    mpm.velocity_filter = Some(VelocityFilter::new(order, RATE).unwrap());
    for _ in 0..steps {
        mpm.step(&free(1.0 / steps as f64)).unwrap();
    }
    let velocities = mpm.particles.in_creation_order(&mpm.particles.velocities);
    let norm = |a: usize| velocities.iter().map(|v| v[a] * v[a]).sum::<f64>();
    let start = |f: &dyn Fn(usize) -> f64| (0..velocities.len()).map(|k| 1e-12 * f(k) * f(k)).sum::<f64>();
    [norm(0) / start(&wave), norm(1) / start(&noise)].map(f64::sqrt)
}

#[test]
fn a_higher_order_keeps_what_is_smooth_and_forgets_noise_at_the_rate() {
    let shares = [1, 2, 5].map(|order| left(order, 50));
    let [first, second, fifth] = shares.map(|[wave, _]| 1.0 - wave);
    assert!(
        first > 0.25 && second < first / 2.0 && fifth < second / 5.0,
        "{first}, {second}, {fifth}"
    );
    for [_, noise] in shares {
        assert!((noise / (-RATE).exp() - 1.0).abs() < 0.1, "{noise}"); // less at the edges
    }
}

#[test]
fn what_is_forgotten_does_not_hang_on_the_number_of_steps() {
    let (few, many) = (left(2, 20), left(2, 100));
    for a in 0..2 {
        assert!((few[a] / many[a] - 1.0).abs() < 0.05, "{few:?}, {many:?}");
    }
}

#[test]
fn the_bits_do_not_hang_on_the_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.02).unwrap();
            let (mpm, _) = filtered(grid, cloud::<2>(15_000), 3);
            assert!(mpm.basis.schedule().parts().len() > 1);
            bits(&mpm.particles.velocities)
        })
    };
    assert!(on(1) == on(2) && on(1) == on(3));
}

#[test]
fn a_filter_without_order_or_rate_is_refused() {
    for (order, rate, field) in [
        (0, 1.0, "order"),
        (2, -1.0, "rate"),
        (2, f64::NAN, "rate"),
        (2, f64::INFINITY, "rate"),
    ] {
        let error = VelocityFilter::<2>::new(order, rate).unwrap_err();
        assert!(matches!(error, MpmError::InvalidParameter { field: named, .. } if named == field));
    }
}

#[test]
fn the_filter_of_a_step_depends_on_its_time_alone() {
    let run = |pause: bool| {
        let grid = || SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.2).unwrap();
        let body = |particles| {
            let gas = IsothermalGas::new(1e-300).unwrap();
            let mut mpm = Mpm::new(particles, grid(), Flip::blend(1.0), gas, Pull::none());
            mpm.velocity_filter = Some(VelocityFilter::new(3, 0.5).unwrap());
            mpm
        };
        let mut mpm = body(cloud::<2>(50));
        for step in 0..30 {
            if pause && step == 17 {
                let time = mpm.time;
                mpm = body(mpm.particles);
                mpm.time = time;
            }
            mpm.step(&free(0.03)).unwrap();
        }
        bits(&mpm.particles.in_creation_order(&mpm.particles.velocities))
    };
    assert!(run(false) == run(true));
}
