//! A cube of Neo-Hookean material that turns and is stretched: particles drift from cell to cell as they do in a simulation.

use mpm_core::{Continuum, Medium, Mpm, NoBodyForce, Particles, SplineGrid, StepControl, Transfer};
use mpm_kernels::Quadratic;
use mpm_materials::{ElasticModuli, NeoHookean};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

/// The order in which particles are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Cell by cell, along the axes.
    Sorted,
    /// At random.
    Shuffled,
}

/// A block on quadratic B-splines in three dimensions.
pub type Block<T> = Mpm<3, SplineGrid<Quadratic, 3, 3>, T, Continuum<NeoHookean>, NoBodyForce>;

/// A cube of `cells`³ cells of spacing 1 with eight particles each, one at random in every octant of a cell. E = 10⁵, ν = 0.3, ρ₀ = 1000 (so that c = 11.6);
/// the velocity is a rotation that reaches 0.15 c at the middle of a face, and a stretching of a fifth of it.
pub fn block<T: Transfer<3>>(cells: usize, order: Order, transfer: T) -> Block<T> {
    let moduli = ElasticModuli::new(1e5, 0.3).expect("in range");
    let medium = Continuum {
        law: NeoHookean::new(moduli),
    };
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let edge = 2 * cells;
    let mut positions = Vec::with_capacity(edge.pow(3));
    for place in 0..edge.pow(3) {
        let octant = [place / (edge * edge), place / edge % edge, place % edge];
        positions.push(octant.map(|c| 0.5 * (c as f64 + random.random::<f64>())));
    }
    if order == Order::Shuffled {
        positions.shuffle(&mut random);
    }
    let (half, volume, density) = (0.5 * cells as f64, 0.125, 1000.0);
    let count = positions.len();
    let mut particles =
        Particles::at_rest(positions, density * volume * count as f64).with_elastic_state(vec![volume; count]);
    let wave_speed = medium.wave_speed(&particles).expect("at rest");
    let rate = 0.15 * wave_speed / half;
    for (x, v) in particles.positions.iter().zip(&mut particles.velocities) {
        let [x, y, z] = x.map(|c| c - half);
        *v = [rate * (0.2 * x - y), rate * (x - 0.2 * y), rate * 0.1 * z];
    }
    let grid = SplineGrid::new([0.0; 3], 1.0).expect("a spacing of one");
    Mpm::new(particles, grid, transfer, medium, NoBodyForce)
}

/// Courant number 0.4.
pub fn control() -> StepControl {
    StepControl {
        time_step: 1.0,
        courant: 0.4,
        displacement: f64::INFINITY,
        friction: 0.0,
    }
}
