//! The nodes ℐ that sample points touch, with their masses and velocities.

use mpm_kernels::{Quadratic, Stencil, UniformGrid};
use mpm_tensor::{Matrix, vector};

use super::{OnlineError, ReducedBody};

/// Nodes per axis of the quadratic kernel.
pub(super) const WIDTH: usize = 3;

/// Nodes in the box around ℐ, at most.
const MOST_PLACES: usize = 1 << 27;

/// ℐ in a box of places: a table says for every place which active node it is. The box grows and stays; only touched places are cleared.
pub(super) struct Nodes<const D: usize> {
    pub grid: UniformGrid<D>,
    /// First node of the box, and nodes per axis.
    lower: [i64; D],
    counts: [usize; D],
    /// Number of the active node at a place, from 1; 0: none.
    table: Vec<u32>,
    /// Places of the active nodes.
    pub places: Vec<usize>,
    /// Places of a stencil's nodes relative to its first.
    offsets: Vec<usize>,
    masses: Vec<f64>,
    /// Momenta; velocities after [`divide`](Self::divide).
    velocities: Vec<[f64; D]>,
}

impl<const D: usize> Nodes<D> {
    pub fn new(grid: UniformGrid<D>) -> Self {
        Self {
            grid,
            lower: [0; D],
            counts: [0; D],
            table: Vec::new(),
            places: Vec::new(),
            offsets: Vec::new(),
            masses: Vec::new(),
            velocities: Vec::new(),
        }
    }

    /// Makes the nodes that these points touch the active ones, without mass; each with the number that an error calls it by.
    pub fn activate<'a>(
        &mut self,
        points: impl Iterator<Item = (usize, &'a [f64; D])> + Clone,
        step: u64,
    ) -> Result<(), OnlineError> {
        for &place in &self.places {
            self.table[place] = 0;
        }
        self.places.clear();
        self.enclose(points.clone(), step)?;
        for (_, x) in points {
            let Some(first) = self.first_place(x) else { continue };
            for offset in &self.offsets {
                let number = &mut self.table[first + offset];
                if *number == 0 {
                    self.places.push(first + offset);
                    *number = self.places.len() as u32;
                }
            }
        }
        self.masses.clear();
        self.masses.resize(self.places.len(), 0.0);
        self.velocities.clear();
        self.velocities.resize(self.places.len(), [0.0; D]);
        Ok(())
    }

    /// Makes the box hold the stencils of these points and of all that share a node with one.
    fn enclose<'a>(
        &mut self,
        points: impl Iterator<Item = (usize, &'a [f64; D])>,
        step: u64,
    ) -> Result<(), OnlineError> {
        let (mut lower, mut upper) = ([i64::MAX; D], [i64::MIN; D]);
        for (sample, x) in points {
            let Some(base) = self.grid.first_node::<Quadratic, WIDTH>(x) else {
                let position = x.to_vec();
                return Err(OnlineError::Position { step, sample, position });
            };
            for a in 0..D {
                lower[a] = lower[a].min(i64::from(base[a]));
                upper[a] = upper[a].max(i64::from(base[a]));
            }
        }
        let reach = WIDTH as i64 - 1;
        let fits = (0..D)
            .all(|a| lower[a] - reach >= self.lower[a] && upper[a] + 2 * reach < self.lower[a] + self.counts[a] as i64);
        if fits || lower[0] > upper[0] {
            return Ok(());
        }
        // Two cells to spare on every side, so that the box is not made anew in every step.
        let counts: [i64; D] = std::array::from_fn(|a| upper[a] - lower[a] + 3 * reach + 5);
        let places: f64 = counts.iter().map(|&count| count as f64).product();
        if places > MOST_PLACES as f64 {
            let most = MOST_PLACES;
            return Err(OnlineError::TooManyNodes { step, places, most });
        }
        self.lower = lower.map(|c| c - reach - 2);
        self.counts = counts.map(|count| count as usize);
        self.table.clear();
        self.table.resize(self.counts.iter().product(), 0);
        let size = Stencil::<WIDTH, D>::SIZE;
        let offset = |number: usize| {
            let digits: [i64; D] =
                std::array::from_fn(|a| (number / WIDTH.pow((D - 1 - a) as u32) % WIDTH) as i64 + self.lower[a]);
            self.place(&digits)
        };
        self.offsets = (0..size).filter_map(offset).collect();
        Ok(())
    }

    /// Place of a node, if it is in the box; the last axis varies fastest.
    #[inline]
    pub fn place(&self, node: &[i64; D]) -> Option<usize> {
        (0..D).try_fold(0, |place: usize, a| {
            let along = node[a] - self.lower[a];
            let inside = along >= 0 && (along as usize) < self.counts[a];
            inside.then(|| place * self.counts[a] + along as usize)
        })
    }

    /// The node at a place.
    pub fn node(&self, mut place: usize) -> [i64; D] {
        let mut node = [0; D];
        for a in (0..D).rev() {
            node[a] = (place % self.counts[a]) as i64 + self.lower[a];
            place /= self.counts[a];
        }
        node
    }

    /// Places in the box.
    pub fn box_size(&self) -> usize {
        self.table.len()
    }

    /// Place of the first node that a point touches; `None` where its stencil is not wholly in the box, so that it touches no active node.
    #[inline]
    fn first_place(&self, x: &[f64; D]) -> Option<usize> {
        let base = self.grid.first_node::<Quadratic, WIDTH>(x)?;
        self.place(&base.map(|c| i64::from(c) + WIDTH as i64 - 1))?;
        self.place(&base.map(i64::from))
    }

    /// Whether a point touches an active node.
    pub fn touched_by(&self, x: &[f64; D]) -> bool {
        let first = self.first_place(x);
        first.is_some_and(|first| self.offsets.iter().any(|offset| self.table[first + offset] != 0))
    }

    /// Adds what a quadrature point sends: N_i m to the mass, N_i (m v + Δt m g) − Δt V τ ∇N_i to the momentum.
    #[inline]
    pub fn add(&mut self, x: &[f64; D], mass: f64, momentum: &[f64; D], flux: &Matrix<D>) {
        let Some(first) = self.first_place(x) else { return };
        Stencil::<WIDTH, D>::new::<Quadratic>(x, &self.grid).for_each(|index, entry| {
            let number = self.table[first + self.offsets[index]] as usize;
            if number != 0 {
                self.masses[number - 1] += entry.weight * mass;
                let sum = &mut self.velocities[number - 1];
                vector::accumulate(sum, entry.weight, momentum);
                vector::accumulate(sum, -1.0, &flux.apply(&entry.gradient));
            }
        });
    }

    /// From momenta to velocities.
    pub fn divide(&mut self) {
        for (velocity, &mass) in self.velocities.iter_mut().zip(&self.masses) {
            if mass > 0.0 {
                *velocity = velocity.map(|c| c / mass);
            }
        }
    }

    /// Gives nodes in held regions their velocities in the step from `time` on.
    pub fn hold(&mut self, body: &ReducedBody<D>, time: f64) {
        if body.held.is_empty() {
            return;
        }
        for number in 0..self.places.len() {
            let x = self
                .grid
                .node_position(&self.node(self.places[number]).map(|c| c as i32));
            if let Some(velocity) = body.held_velocity(&x, time) {
                self.velocities[number] = velocity;
            }
        }
    }

    /// Σ N_i v_i at a sample point. Where nodes have no mass, those that have some stand for all (ours): the sum over them, divided by Σ N_i; `None` if there are none.
    pub fn velocity_at(&self, x: &[f64; D]) -> Option<[f64; D]> {
        let first = self.first_place(x)?;
        let (mut velocity, mut weight, mut empty) = ([0.0; D], 0.0, false);
        Stencil::<WIDTH, D>::new::<Quadratic>(x, &self.grid).for_each(|index, entry| {
            let number = self.table[first + self.offsets[index]] as usize;
            if number != 0 && self.masses[number - 1] > 0.0 {
                vector::accumulate(&mut velocity, entry.weight, &self.velocities[number - 1]);
                weight += entry.weight;
            } else {
                empty = true;
            }
        });
        match empty {
            false => Some(velocity),
            true => (weight > 0.0).then(|| velocity.map(|c| c / weight)),
        }
    }
}
