//! The block of `experiments/scenes/block_on_incline.toml` by finite elements: what the material point method is to be held against there.
//!
//!     cargo run --release -p mpm-scenes --example block_of_elements
//!
//! Bilinear squares of a linear elastic solid in plane strain, lumped masses, central differences. The lowest nodes go no farther than the floor, and what they lose of their way along it is at most μ of what the floor takes.

#![allow(clippy::print_stdout)]

/// A block of this length and height on a slope of 30°, whose gravity is given along the slope and into it.
const SIZE: [f64; 2] = [1.0, 0.5];
const GRAVITY: [f64; 2] = [5.0, -8.660254037844386];
const DENSITY: f64 = 1000.0;
/// λ and μ of E = 1 MPa, ν = 0.3.
const LAME: [f64; 2] = [1e6 * 0.3 / (1.3 * 0.4), 1e6 / 2.6];

/// What the runs differ by.
#[derive(Clone, Copy, Default)]
struct Loading {
    /// Time in which gravity grows.
    ramp: f64,
    /// Rate at which velocities fall.
    damping: f64,
}

/// μ of the slope, and how long the block is watched.
const FRICTION: f64 = 0.7;
const END: f64 = 4.0;

/// ∂N/∂x of the four nodes at a point of the unit square, for elements of edge h.
fn gradients([s, t]: [f64; 2], h: f64) -> [[f64; 2]; 4] {
    [[t - 1.0, s - 1.0], [1.0 - t, -s], [t, s], [-t, 1.0 - s]].map(|gradient| gradient.map(|c| c / h))
}

/// Forces on the nodes of one element with these displacements, by 2 × 2 points of Gauss.
fn element_forces(u: &[[f64; 2]; 4], h: f64) -> [[f64; 2]; 4] {
    let mut forces = [[0.0; 2]; 4];
    let points = [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()];
    for point in points.iter().flat_map(|&s| points.map(|t| [s, t])) {
        let g = gradients(point, h);
        let slope = |a: usize, b: usize| (0..4).map(|k| u[k][a] * g[k][b]).sum::<f64>();
        let shear = LAME[1] * (slope(0, 1) + slope(1, 0));
        let pressure = LAME[0] * (slope(0, 0) + slope(1, 1));
        let normal = [0, 1].map(|a| pressure + 2.0 * LAME[1] * slope(a, a));
        for k in 0..4 {
            forces[k][0] -= 0.25 * h * h * (normal[0] * g[k][0] + shear * g[k][1]);
            forces[k][1] -= 0.25 * h * h * (shear * g[k][0] + normal[1] * g[k][1]);
        }
    }
    forces
}

/// How far the centre of mass has gone along the slope.
fn way(elements: usize, loading: Loading) -> f64 {
    let [columns, rows] = [elements, elements / 2];
    let h = SIZE[0] / columns as f64;
    let node = |i: usize, j: usize| j * (columns + 1) + i;
    let cells: Vec<[usize; 4]> = (0..columns * rows)
        .map(|k| (k % columns, k / columns))
        .map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)])
        .collect();
    let mut masses = vec![0.0; node(columns, rows) + 1];
    for &k in cells.iter().flatten() {
        masses[k] += 0.25 * DENSITY * h * h;
    }
    let time_step = 0.25 * h / ((LAME[0] + 2.0 * LAME[1]) / DENSITY).sqrt();
    let (mut u, mut v) = (vec![[0.0; 2]; masses.len()], vec![[0.0; 2]; masses.len()]);
    for step in 0..(END / time_step) as usize {
        let time = step as f64 * time_step;
        let share = if time < loading.ramp { time / loading.ramp } else { 1.0 };
        let mut forces = vec![[0.0; 2]; masses.len()];
        for cell in &cells {
            let local = element_forces(&cell.map(|k| u[k]), h);
            for (&k, force) in cell.iter().zip(local) {
                (0..2).for_each(|a| forces[k][a] += force[a]);
            }
        }
        for (k, velocity) in v.iter_mut().enumerate() {
            for a in 0..2 {
                let acceleration = forces[k][a] / masses[k] + share * GRAVITY[a];
                velocity[a] = (velocity[a] + time_step * acceleration) * (-loading.damping * time_step).exp();
            }
        }
        for k in 0..=columns {
            let taken = (-u[k][1].max(0.0) / time_step - v[k][1]).max(0.0);
            v[k][1] += taken;
            v[k][0] = v[k][0].signum() * (v[k][0].abs() - FRICTION * taken).max(0.0);
        }
        for (place, velocity) in u.iter_mut().zip(&v) {
            (0..2).for_each(|a| place[a] += time_step * velocity[a]);
        }
    }
    let total: f64 = masses.iter().sum();
    u.iter().zip(&masses).map(|(u, mass)| u[0] * mass).sum::<f64>() / total
}

fn main() {
    let at_once = Loading::default();
    let ramp = Loading { ramp: 0.5, ..at_once };
    let damped = Loading {
        damping: 10.0,
        ..at_once
    };
    println!("elements along the block   at once   within 0.5 s   damping 10 per s: way in {END} s");
    for elements in [10, 20, 40] {
        let [a, b, c] = [at_once, ramp, damped].map(|loading| way(elements, loading));
        println!("{elements:24} {a:9.3} {b:14.5} {c:18.4}");
    }
}
