//! The step against the textbook: every transfer, law and kind of body force.

use mpm_core::{AffineFlip, Apic, Flip, Masses, Medium, Mpm, Particles, Pic, SplineGrid, Transfer, UniformBasis};
use mpm_kernels::{Cubic, Linear, Quadratic, Spline};
use mpm_materials::{ElasticModuli, IsothermalGas, LinearElastic, NeoHookean};
use mpm_tensor::Matrix;
use rand::RngExt;

use crate::naive_step::{Force, Kernel, Law, NaiveGrid, NaiveParticle, Velocity, naive_step};
use crate::scenes::{Pull, free, generator, normal, solid};

const LAMBDA: f64 = 1.5;
const MU: f64 = 2.0;
const STEPS: usize = 6;
const TIME_STEP: f64 = 0.01;

fn pull<const D: usize>(x: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|a| 0.3 - 1.2 * x[a] + 0.1 * x[(a + 1) % D])
}

/// Not proportional to the mass, and bounded by it so that light nodes stay tame.
fn nodal_pull<const D: usize>(x: &[f64; D], mass: f64) -> [f64; D] {
    pull(x).map(|c| c * mass / (1.0 + mass))
}

/// A cube of particles with different masses, volumes, velocities, affine moments and deformations.
fn body<const D: usize>(seed: u64) -> Vec<NaiveParticle<D>> {
    let mut random = generator(seed);
    let count = 20 * D;
    let particle = |_| {
        let near = |random: &mut rand::rngs::ChaCha8Rng, scale: f64| {
            Matrix::<D>::from_fn(|_, _| scale * (2.0 * random.random::<f64>() - 1.0))
        };
        NaiveParticle {
            x: std::array::from_fn(|_| 2.0 * random.random::<f64>() - 1.0),
            v: normal::<D>(&mut random).map(|c| 0.3 * c),
            mass: (0.5 + random.random::<f64>()) / count as f64,
            volume: (0.5 + random.random::<f64>()) * 2f64.powi(D as i32) / count as f64,
            affine: near(&mut random, 0.02),
            deformation: Matrix::IDENTITY + near(&mut random, 0.1),
        }
    };
    (0..count).map(particle).collect()
}

/// What of a particle a step has, beside position and velocity.
#[derive(Clone, Copy)]
struct Fields {
    affine: bool,
    deforms: bool,
}

/// The same particles for the step.
fn particles_of<const D: usize>(naive: &[NaiveParticle<D>], fields: Fields) -> Particles<D> {
    let mut particles = Particles::at_rest(naive.iter().map(|p| p.x).collect(), 1.0);
    particles.masses = Masses::Each(naive.iter().map(|p| p.mass).collect());
    particles.velocities = naive.iter().map(|p| p.v).collect();
    if fields.affine {
        particles.affine = naive.iter().map(|p| p.affine).collect();
    }
    if fields.deforms {
        particles = particles.with_elastic_state(naive.iter().map(|p| p.volume).collect());
        particles.deformation_gradients = naive.iter().map(|p| p.deformation).collect();
    }
    particles
}

/// Every number of every particle is the textbook's.
fn are_those_of<const D: usize>(naive: &[NaiveParticle<D>], fields: Fields, particles: &Particles<D>, what: &str) {
    let close = |ours: f64, theirs: f64, field: &str| {
        assert!(
            (ours - theirs).abs() < 1e-12 * (1.0 + theirs.abs()),
            "{what}: {field} {ours} for {theirs}"
        );
    };
    let positions = particles.in_creation_order(&particles.positions);
    let velocities = particles.in_creation_order(&particles.velocities);
    let affine = particles.in_creation_order(&particles.affine);
    let deformation = particles.in_creation_order(&particles.deformation_gradients);
    for (k, expected) in naive.iter().enumerate() {
        for a in 0..D {
            close(positions[k][a], expected.x[a], "x");
            close(velocities[k][a], expected.v[a], "v");
            for b in 0..D {
                if fields.affine {
                    close(affine[k].0[a][b], expected.affine.0[a][b], "B");
                }
                if fields.deforms {
                    close(deformation[k].0[a][b], expected.deformation.0[a][b], "F");
                }
            }
        }
    }
}

/// Compare `STEPS` steps; the grid moves after every one.
fn agree<S: Spline<W>, T: Transfer<D>, M: Medium<D, State = ()>, const W: usize, const D: usize>(
    (kernel, velocity, law, force): (Kernel, Velocity, Law, Force<D>),
    (transfer, medium): (T, M),
    (friction, displacement): (f64, f64),
) {
    let body_force = match force {
        Force::None => Pull::none(),
        Force::Particles(g) => Pull::at_particles(g),
        Force::Nodes(f) => Pull::at_nodes(f),
    };
    let mut naive = body::<D>(40 + D as u64);
    let (h, dt) = (0.45, TIME_STEP);
    let fields = Fields {
        affine: T::AFFINE,
        deforms: M::DEFORMS,
    };
    let grid = SplineGrid::<S, W, D>::new([0.0; D], h).unwrap();
    let mut mpm = Mpm::new(particles_of(&naive, fields), grid, transfer, medium, body_force);
    let mut control = free(dt);
    (control.friction, control.displacement) = (friction, displacement);
    for step in 0..STEPS {
        let origin = [0.13 * step as f64; D];
        mpm.basis.place(origin, h).unwrap();
        mpm.step(&control).unwrap();
        let grid = NaiveGrid { kernel, origin, h };
        naive_step(&mut naive, &grid, law, velocity, force, (dt, friction, displacement));

        let what = format!("{}, {velocity:?}, {law:?}, {force:?}, D = {D}, step {step}", S::NAME);
        are_those_of(&naive, fields, &mpm.particles, &what);
    }
}

fn every_force<S: Spline<W>, T: Transfer<D>, M: Medium<D, State = ()> + Copy, const W: usize, const D: usize>(
    (kernel, velocity, law): (Kernel, Velocity, Law),
    ours: (T, M),
) {
    // Hats give light nodes large velocities: there the limit of the displacement is at work, elsewhere there is none.
    let limit = if W == 2 { 0.1 } else { f64::INFINITY };
    agree::<S, T, M, W, D>((kernel, velocity, law, Force::None), ours, (0.0, limit));
    agree::<S, T, M, W, D>((kernel, velocity, law, Force::Particles(pull)), ours, (0.7, limit));
    agree::<S, T, M, W, D>((kernel, velocity, law, Force::Nodes(nodal_pull)), ours, (0.7, 0.05));
}

fn gas<S: Spline<W>, T: Transfer<D>, const W: usize, const D: usize>(kernel: Kernel, velocity: Velocity, transfer: T) {
    let gas = IsothermalGas::new(0.8).unwrap();
    every_force::<S, T, _, W, D>((kernel, velocity, Law::Gas { kappa: 0.8 }), (transfer, gas));
}

fn solids<S: Spline<W>, T: Transfer<D>, const W: usize, const D: usize>(
    kernel: Kernel,
    velocity: Velocity,
    transfer: T,
) {
    let moduli = ElasticModuli::from_lame(LAMBDA, MU).unwrap();
    let (lambda, mu) = (LAMBDA, MU);
    let neo_hookean = solid(NeoHookean::new(moduli));
    every_force::<S, T, _, W, D>(
        (kernel, velocity, Law::NeoHookean { lambda, mu }),
        (transfer, neo_hookean),
    );
    let linear = solid(LinearElastic::new(moduli));
    every_force::<S, T, _, W, D>(
        (kernel, velocity, Law::LinearElastic { lambda, mu }),
        (transfer, linear),
    );
}

/// FLIP of a constant share and with a rate at which the share decays, and the share that is left after a step.
fn flips() -> [(f64, Flip); 2] {
    let decaying = Flip {
        share: 0.95,
        pic_rate: 6.0,
    };
    let left = decaying.share * (-decaying.pic_rate * TIME_STEP).exp();
    [(0.9, Flip::blend(0.9)), (left, decaying)]
}

/// Every transfer, with a gas under those that have no gradient of velocities and with solids under the others.
fn affine_solids<S: Spline<W>, const W: usize, const D: usize>(kernel: Kernel) {
    gas::<S, _, W, D>(kernel, Velocity::Pic, Pic);
    solids::<S, _, W, D>(kernel, Velocity::Apic, Apic);
    for (share, flip) in flips() {
        gas::<S, _, W, D>(kernel, Velocity::Flip(share), flip);
        solids::<S, _, W, D>(kernel, Velocity::AffineFlip(share), AffineFlip::new(flip));
    }
}

/// Every transfer, the other way round.
fn affine_gas<S: Spline<W>, const W: usize, const D: usize>(kernel: Kernel) {
    solids::<S, _, W, D>(kernel, Velocity::Pic, Pic);
    gas::<S, _, W, D>(kernel, Velocity::Apic, Apic);
    for (share, flip) in flips() {
        solids::<S, _, W, D>(kernel, Velocity::Flip(share), flip);
        gas::<S, _, W, D>(kernel, Velocity::AffineFlip(share), AffineFlip::new(flip));
    }
}

// Every pair of transfer, medium, kernel and dimension occurs; every triple would take twice as long to compile.

#[test]
fn the_step_is_the_textbook_s_in_every_dimension() {
    affine_solids::<Quadratic, 3, 1>(Kernel::Quadratic);
    affine_solids::<Quadratic, 3, 2>(Kernel::Quadratic);
    affine_gas::<Quadratic, 3, 2>(Kernel::Quadratic);
    affine_solids::<Quadratic, 3, 3>(Kernel::Quadratic);
}

#[test]
fn the_step_is_the_textbook_s_with_every_kernel() {
    affine_solids::<Linear, 2, 2>(Kernel::Linear);
    affine_solids::<Cubic, 4, 2>(Kernel::Cubic);
}
