//! A shape of the plane with exact draws and its evidence, from a fine grid.

use rand::{Rng, RngExt};

use crate::shapes::Shape;

/// Cells per axis.
const CELLS: usize = 3000;

/// Steps of differences, in lengths of 1 + |z|.
const STEP: f64 = 1e-6;

/// A shape, and how much of its mass is in the cells so far.
pub struct Plane {
    pub name: &'static str,
    /// log ∫ f by the midpoint rule.
    pub log_evidence: f64,
    shape: Shape,
    sums: Vec<f64>,
}

impl Plane {
    pub fn new(shape: Shape) -> Self {
        let middle = |cell: usize, half: f64| (2.0 * (cell as f64 + 0.5) / CELLS as f64 - 1.0) * half;
        let at = |cell: usize| [middle(cell / CELLS, shape.half[0]), middle(cell % CELLS, shape.half[1])];
        let logs: Vec<f64> = (0..CELLS * CELLS).map(|cell| (shape.log_density)(at(cell))).collect();
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut sum = 0.0;
        let add = |log: &f64| {
            sum += (log - top).exp();
            sum
        };
        let sums: Vec<f64> = logs.iter().map(add).collect();
        let area = 4.0 * shape.half[0] * shape.half[1] / (CELLS * CELLS) as f64;
        Self {
            name: shape.name,
            log_evidence: top + (sum * area).ln(),
            shape,
            sums,
        }
    }

    pub fn log_density(&self, z: [f64; 2]) -> f64 {
        (self.shape.log_density)(z)
    }

    /// By central differences.
    pub fn score(&self, z: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|axis| {
            let step = STEP * (1.0 + z[axis].abs());
            let [below, above] = [-step, step].map(|step| {
                let mut moved = z;
                moved[axis] += step;
                self.log_density(moved)
            });
            (above - below) / (2.0 * step)
        })
    }

    /// A cell by its mass, and a point of it.
    pub fn draw(&self, rng: &mut impl Rng) -> [f64; 2] {
        let mass = rng.random::<f64>() * self.sums[self.sums.len() - 1];
        let cell = self.sums.partition_point(|&sum| sum < mass);
        let mut place =
            |cell: usize, half: f64| (2.0 * (cell as f64 + rng.random::<f64>()) / CELLS as f64 - 1.0) * half;
        [
            place(cell / CELLS, self.shape.half[0]),
            place(cell % CELLS, self.shape.half[1]),
        ]
    }
}
