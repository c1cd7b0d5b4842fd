//! A bar that swings along its axis (Cao et al. 2024, §3.1).

use std::f64::consts::PI;

use mpm_core::{Basis, Boundaries, Contact, Flip, Mpm, NoBodyForce, Particles, Plane};
use mpm_materials::{ElasticModuli, LinearElastic};
use mpm_mesh::{Gradient, MeshBasis, SampleWeight};

use super::{control, solid};
use crate::basis_scenes::line;

const LENGTH: f64 = 25.0;
const YOUNG: f64 = 100.0;
const SPEED: f64 = 0.75;
const HALF_PERIOD: f64 = 5.0;

/// The root mean square error of the centre of mass over half a period, in amplitudes. P = E (F − 1), ρ = 1, `per_cell` particles per cell, full
/// FLIP, cells of size `h` from `outer` cells before the bar on; nodes at and before its fixed end rest.
fn error(h: f64, outer: usize, per_cell: usize) -> f64 {
    let last = ((LENGTH + 1.3) / h).ceil() as usize + 1; // the free end swings by 1.19
    let nodes: Vec<f64> = (0..=last + outer).map(|k| h * (k as f64 - outer as f64)).collect();
    error_on(MeshBasis::new(&line(&nodes)).unwrap(), h, per_cell)
}

/// The same on a mesh whose mean edge is `h`.
fn error_on(basis: MeshBasis<1>, h: f64, per_cell: usize) -> f64 {
    let shortest = basis.spacing();
    let count = (per_cell as f64 * LENGTH / h).round() as usize;
    let size = LENGTH / count as f64;
    let positions: Vec<[f64; 1]> = (0..count).map(|p| [size * (p as f64 + 0.5)]).collect();
    let wave_number = PI / (2.0 * LENGTH);
    let mut particles = Particles::at_rest(positions, LENGTH).with_elastic_state(vec![size; count]);
    for (v, x) in particles.velocities.iter_mut().zip(&particles.positions) {
        v[0] = SPEED * (wave_number * x[0]).sin();
    }
    let wall = Plane {
        point: [0.0],
        normal: [1.0],
        contact: Contact::Stick,
        velocity: [0.0],
    };
    let law = LinearElastic::new(ElasticModuli::new(YOUNG, 0.0).unwrap());
    let body = Mpm::new(particles, basis, Flip::blend(1.0), solid(law), NoBodyForce);
    let mut body = body.with_boundary(Boundaries::new(vec![wall], Vec::new()));
    let frequency = wave_number * YOUNG.sqrt();
    let amplitude = SPEED / (wave_number * LENGTH * frequency);
    let steps = (HALF_PERIOD / (0.3 * shortest / YOUNG.sqrt())).ceil() as usize;
    let dt = HALF_PERIOD / steps as f64;
    let mut squares = 0.0;
    for _ in 0..steps {
        body.step(&control(dt)).unwrap();
        let centre = body.particles.positions.iter().map(|x| x[0]).sum::<f64>() / count as f64;
        let exact = LENGTH / 2.0 + amplitude * (frequency * body.time).sin();
        squares += ((centre - exact) / amplitude).powi(2);
    }
    (squares / steps as f64).sqrt()
}

/// Nodes at the fixed end alone, and with cells behind it whose nodes are images of those before it (`Plane`).
#[test]
fn the_centre_of_mass_swings_as_it_should() {
    for (outer, per_cell) in [(0, 2), (0, 4), (2, 2), (2, 4)] {
        let spacings = [2.0, 1.0, 0.5, 0.25];
        let errors = spacings.map(|h| error(h, outer, per_cell));
        let order = (errors[0] / errors[2]).log2() / 2.0;
        println!("{outer} cells outside, {per_cell} particles per cell: {errors:?} for {spacings:?}, order {order}");
        assert!(errors[1..].iter().all(|&error| error <= 0.00554), "{errors:?}");
        assert!((order - 2.0).abs() < 0.2, "order {order}");
    }
}

/// On segments of lengths 1 : 2 : 1.5 diffuse gradients leave the bar too soft at any size; exact ones converge.
#[test]
fn exact_gradients_converge_on_unequal_segments() {
    let error = |h: f64, weight, gradient| {
        let lengths = [1.0, 2.0, 1.5].map(|share| share * h / 1.5);
        let mut nodes = vec![0.0];
        while nodes[nodes.len() - 1] < LENGTH + 1.3 + 2.0 * h {
            nodes.push(nodes[nodes.len() - 1] + lengths[(nodes.len() - 1) % 3]);
        }
        let basis = MeshBasis::new(&line(&nodes)).unwrap().with_sample_weight(weight);
        error_on(basis.with_gradient(gradient), h, 8)
    };
    let sizes = [1.0, 0.5, 0.25];
    let diffuse = sizes.map(|h| error(h, SampleWeight::Continuous, Gradient::Diffuse));
    let exact = sizes.map(|h| error(h, SampleWeight::Smooth, Gradient::Exact));
    println!("diffuse {diffuse:?}, exact {exact:?} for {sizes:?}");
    assert!(diffuse[2] > 0.8 * diffuse[1], "{diffuse:?}");
    let order = (exact[0] / exact[2]).log2() / 2.0;
    assert!(order > 1.8, "{exact:?}: order {order}");
}
