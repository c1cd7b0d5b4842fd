//! The step on a mesh against the textbook: sums over all vertices, weights by their definition.

use crate::basis_scenes::{cloud, cube, generator, naive_weights};
use mpm_core::{Apic, Flip, Masses, Mls, Mpm, NoBodyForce, Particles, Transfer};
use mpm_materials::{ElasticModuli, NeoHookean};
use mpm_mesh::{MeshBasis, SampleWeight, SimplexMesh};
use mpm_tensor::Matrix;
use mpm_tensor::vector::{accumulate, subtract};
use rand::RngExt;

use super::{control, solid};

const LAMBDA: f64 = 1.5;
const MU: f64 = 2.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Velocity {
    Flip(f64),
    Apic,
    LeastSquares,
}

#[derive(Clone)]
struct Particle<const D: usize> {
    x: [f64; D],
    v: [f64; D],
    mass: f64,
    volume: f64,
    affine: Matrix<D>,
    deformation: Matrix<D>,
}

/// P2G, v_i = (Σ momentum + Δt Σ force) / m_i, G2P, all by their formulas.
#[allow(non_snake_case)]
fn naive_step<const D: usize>(mesh: &SimplexMesh<D>, particles: &mut [Particle<D>], velocity: Velocity, dt: f64) {
    let nodes = mesh.vertices();
    let cell_of = |x: &[f64; D]| {
        (0..mesh.cell_count())
            .find(|&cell| mesh.frame(cell).least_coordinate(x) >= 0.0)
            .unwrap()
    };
    let affine = velocity == Velocity::Apic || velocity == Velocity::LeastSquares;
    let (mut masses, mut momenta) = (vec![0.0; nodes.len()], vec![[0.0; D]; nodes.len()]);
    let mut impulses = momenta.clone();
    let mut seen = Vec::new();
    for p in particles.iter() {
        let weights = naive_weights(mesh, cell_of(&p.x), &p.x, SampleWeight::Continuous);
        let offsets: Vec<[f64; D]> = nodes.iter().map(|node| subtract(node, &p.x)).collect();
        let mut spread = Matrix::<D>::ZERO;
        for ((w, _), r) in weights.iter().zip(&offsets) {
            spread += Matrix::outer(r, r) * *w;
        }
        let inverse = spread.inverse().unwrap();
        let F = p.deformation;
        let inverse_transpose = F.inverse().unwrap().transpose();
        let stress =
            ((F - inverse_transpose) * MU + inverse_transpose * (LAMBDA * F.determinant().ln())) * F.transpose();
        for (i, ((w, gradient), r)) in weights.iter().zip(&offsets).enumerate() {
            let direction = inverse.apply(r).map(|c| w * c);
            masses[i] += w * p.mass;
            accumulate(&mut momenta[i], w * p.mass, &p.v);
            if affine {
                accumulate(&mut momenta[i], p.mass, &p.affine.apply(&direction));
            }
            let slope = if velocity == Velocity::LeastSquares {
                &direction
            } else {
                gradient
            };
            accumulate(&mut impulses[i], -dt * p.volume, &stress.apply(slope));
        }
        seen.push((weights, offsets, inverse));
    }
    let quotient = |i: usize, sum: &[f64; D]| {
        if masses[i] == 0.0 {
            [0.0; D]
        } else {
            sum.map(|c| c / masses[i])
        }
    };
    let old: Vec<[f64; D]> = (0..nodes.len()).map(|i| quotient(i, &momenta[i])).collect();
    let new: Vec<[f64; D]> = (0..nodes.len())
        .map(|i| quotient(i, &std::array::from_fn(|a| momenta[i][a] + impulses[i][a])))
        .collect();
    for (p, (weights, offsets, inverse)) in particles.iter_mut().zip(seen) {
        let (mut value, mut change) = ([0.0; D], [0.0; D]);
        let (mut moment, mut gradient) = (Matrix::<D>::ZERO, Matrix::<D>::ZERO);
        for (i, ((w, g), r)) in weights.iter().zip(&offsets).enumerate() {
            accumulate(&mut value, *w, &new[i]);
            accumulate(&mut change, *w, &subtract(&new[i], &old[i]));
            moment += Matrix::outer(&new[i], r) * *w;
            gradient += Matrix::outer(&new[i], g);
        }
        if velocity == Velocity::LeastSquares {
            gradient = moment * inverse;
        }
        accumulate(&mut p.x, dt, &value);
        p.v = match velocity {
            Velocity::Flip(share) => std::array::from_fn(|a| (1.0 - share) * value[a] + share * (p.v[a] + change[a])),
            _ => value,
        };
        p.affine = moment;
        p.deformation = (Matrix::IDENTITY + gradient * dt) * p.deformation;
    }
}

fn agree<const D: usize, T: Transfer<D>>(cells: usize, velocity: Velocity, transfer: T) {
    let mesh = cube::<D>(cells, 0.5, 0.15, 11);
    let edge = 0.5 * cells as f64;
    let mut random = generator(12);
    let mut small = |scale: f64| Matrix::<D>::from_fn(|_, _| scale * random.random_range(-1.0..1.0));
    let positions = cloud::<D>(30 * D, 0.3 * edge, 0.7 * edge, 13);
    let mut naive: Vec<Particle<D>> = positions
        .iter()
        .map(|&x| Particle {
            x,
            v: small(0.5).0[0],
            mass: 0.02 + small(0.01).0[0][0],
            volume: 0.03 + small(0.01).0[0][0],
            affine: small(0.02),
            deformation: Matrix::IDENTITY + small(0.1),
        })
        .collect();
    let mut particles = Particles::at_rest(positions, 1.0).with_elastic_state(naive.iter().map(|p| p.volume).collect());
    particles.masses = Masses::Each(naive.iter().map(|p| p.mass).collect());
    particles.velocities = naive.iter().map(|p| p.v).collect();
    particles.deformation_gradients = naive.iter().map(|p| p.deformation).collect();
    if T::AFFINE {
        particles.affine = naive.iter().map(|p| p.affine).collect();
    }
    let medium = solid(NeoHookean::new(ElasticModuli::from_lame(LAMBDA, MU).unwrap()));
    let mut mpm = Mpm::new(particles, MeshBasis::new(&mesh).unwrap(), transfer, medium, NoBodyForce);
    let dt = 0.002;
    for step in 0..5 {
        mpm.step(&control(dt)).unwrap();
        naive_step(&mesh, &mut naive, velocity, dt);
        let p = &mpm.particles;
        let (x, v) = (p.in_creation_order(&p.positions), p.in_creation_order(&p.velocities));
        let (affine, deformation) = (
            p.in_creation_order(&p.affine),
            p.in_creation_order(&p.deformation_gradients),
        );
        for (k, expected) in naive.iter().enumerate() {
            let what = format!("{velocity:?}, D = {D}, step {step}, particle {k}");
            let close = |ours: f64, theirs: f64, field: &str| {
                let error = (ours - theirs).abs() / (1.0 + theirs.abs());
                assert!(error < 1e-11, "{what}: {field} {ours} for {theirs}");
            };
            for a in 0..D {
                close(x[k][a], expected.x[a], "x");
                close(v[k][a], expected.v[a], "v");
                for b in 0..D {
                    close(deformation[k].0[a][b], expected.deformation.0[a][b], "F");
                    if T::AFFINE {
                        close(affine[k].0[a][b], expected.affine.0[a][b], "B");
                    }
                }
            }
        }
    }
}

/// PIC and affine FLIP ask a basis for nothing that FLIP and APIC do not; mpm-core has them on grids.
#[test]
fn the_step_is_the_textbook_s() {
    agree::<1, _>(12, Velocity::Flip(0.9), Flip::blend(0.9));
    agree::<2, _>(6, Velocity::Flip(0.9), Flip::blend(0.9));
    agree::<2, _>(6, Velocity::Apic, Apic);
    agree::<2, _>(6, Velocity::LeastSquares, Mls);
    agree::<3, _>(4, Velocity::Apic, Apic);
}
