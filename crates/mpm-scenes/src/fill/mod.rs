//! Particles in a shape.

mod mesh_points;
mod poisson_disk;
mod random;
mod regular;
mod rings;

pub(crate) use mesh_points::{centroids, in_cells, vertices};
pub use poisson_disk::poisson_disk;
pub use random::random;
pub use regular::regular;
pub use rings::rings;

use crate::SceneFault;

/// The particles of one body at rest: positions and reference volumes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filling<const D: usize> {
    /// X_p.
    pub positions: Vec<[f64; D]>,
    /// Their volumes V_p.
    pub volumes: Vec<f64>,
}

impl<const D: usize> Filling<D> {
    /// Particles that all have the same volume.
    pub fn of_equal(positions: Vec<[f64; D]>, volume: f64) -> Self {
        let volumes = vec![volume; positions.len()];
        Self { positions, volumes }
    }

    /// Σ V_p.
    pub fn volume(&self) -> f64 {
        self.volumes.iter().sum()
    }
}

/// Points of a lattice that are looked at, at most.
const MOST_POINTS: f64 = 5e8;

/// Whole numbers of steps that cover the sides of a box, unless there are more than `most` of them; `body` is whose they are.
fn counts<const D: usize>(body: &str, sides: &[f64; D], steps: &[f64; D], most: f64) -> Result<[u64; D], SceneFault> {
    let counts: [f64; D] = std::array::from_fn(|a| (sides[a] / steps[a]).ceil().max(0.0));
    let product: f64 = counts.iter().product();
    if product <= most {
        return Ok(counts.map(|count| count as u64));
    }
    Err(SceneFault::TooManyPoints {
        body: body.to_owned(),
        key: "spacing",
        distance: steps.iter().copied().fold(f64::INFINITY, f64::min),
        most,
    })
}

/// The place in a box of `counts` cells that has this number; the last axis varies fastest.
fn place<const D: usize>(counts: &[u64; D], mut number: u64) -> [u64; D] {
    let mut place = [0; D];
    for a in (0..D).rev() {
        place[a] = number % counts[a].max(1);
        number /= counts[a].max(1);
    }
    place
}
