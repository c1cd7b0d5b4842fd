//! What affine FLIP makes of kinetic energy without a force, and with a wall alone.

use mpm_core::{AffineFlip, Boundaries, Contact, Flip, Moments, Mpm, Particles, Plane, SplineGrid};
use mpm_kernels::Quadratic;
use mpm_materials::IsothermalGas;
use mpm_tensor::Matrix;

use crate::scenes::{Pull, free, uniform_cloud};

const SPACING: f64 = 0.25;

/// Kinetic energy with that of the affine parts, D_p = h² / 4: at the start, and after every step of a cloud that runs towards its centre, against a wall that holds if there is one.
fn energies(moments: Moments, wall: Option<f64>) -> Vec<f64> {
    let count = 80;
    let mut particles = Particles::at_rest(uniform_cloud::<2>(count, 1.0, 8), 1.0);
    let velocity = |x: &[f64; 2]| [(9.0 * x[1]).sin() - x[0], (9.0 * x[0]).sin() - x[1]];
    particles.velocities = particles.positions.iter().map(velocity).collect();
    particles.affine = vec![Matrix::ZERO; count];
    let walls = wall.map(|position| Plane {
        point: [0.0, position],
        normal: [0.0, 1.0],
        contact: Contact::Stick,
        velocity: [0.0; 2],
    });
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], SPACING).unwrap();
    let flip = Flip::blend(1.0);
    let (transfer, still) = (AffineFlip { flip, moments }, IsothermalGas::new(1e-12).unwrap());
    let body = Mpm::new(particles, grid, transfer, still, Pull::none());
    let mut body = body.with_boundary(Boundaries::new(walls.into_iter().collect(), Vec::new()));
    let mut energies = Vec::new();
    for step in 0..=60 {
        if step > 0 {
            body.step(&free(0.01)).unwrap();
        }
        let each = body.particles.velocities.iter().zip(&body.particles.affine);
        let each = each.map(|(v, b)| v[0] * v[0] + v[1] * v[1] + b.contract(b) * 4.0 / (SPACING * SPACING));
        energies.push(0.5 * each.sum::<f64>() / count as f64);
    }
    energies
}

#[test]
fn free_flight_makes_energy_of_the_moments_of_nodes_and_none_of_increments() {
    let of_nodes = energies(Moments::OfNodes, None);
    let largest = of_nodes.iter().fold(0.0, |most: f64, e| most.max(*e));
    assert!(largest > 1.1 * of_nodes[0], "{of_nodes:?}");
    let increments = energies(Moments::Increments, None);
    let kept = increments.iter().all(|e| (e / increments[0] - 1.0).abs() < 1e-12);
    assert!(kept, "{increments:?}");
}

#[test]
fn a_wall_takes_energy_of_increments() {
    let energies = energies(Moments::Increments, Some(0.1));
    assert!(
        energies.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12)),
        "{energies:?}"
    );
    assert!(energies[60] < 0.99 * energies[0], "{energies:?}");
}
