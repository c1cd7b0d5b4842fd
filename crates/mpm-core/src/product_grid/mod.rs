//! Tensor-product splines whose degree is known at run time only: compiled once per dimension, for dimensions in which a stencil has so
//! many nodes that nobody computes with them for speed.

mod degree;
mod numbers;
mod rows;

use mpm_kernels::{Columns, Deposit, Entry, Interpolated, NodeField, NodeSink, UniformGrid, Wanted};
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

pub use self::degree::SplineDegree;
use self::numbers::NodeNumbers;
use self::rows::{Rows, add_column, add_row, advance};
use crate::basis::{Member, add_scaled, check_placement, placed_grid};
use crate::{Basis, MpmError, Schedule, UniformBasis};

/// Node numbers that are stored, at most; beyond, they are looked up whenever they are asked for.
const MOST_STORED: usize = 1 << 26;

/// The nodes {origin + h i : i ∈ ℤᴰ} with the shape functions of [`SplineGrid`](crate::SplineGrid), by a loop over the Wᴰ nodes of a particle.
/// Every particle is a cell of its own; nodes are found by their places in the box around them all, or by hashing where that is large.
#[derive(Clone, Debug)]
pub struct ProductGrid<const D: usize> {
    degree: SplineDegree,
    nodes: UniformGrid<D>,
    numbers: NodeNumbers<D>,
    /// The first node of every particle.
    bases: Vec<[i32; D]>,
    /// The node numbers of every particle, where they are stored.
    stencils: Vec<u32>,
    schedule: Schedule,
}

impl<const D: usize> ProductGrid<D> {
    /// A grid of spacing `h` with a node at `origin`.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless `h` is positive and `h` and `origin` are finite.
    pub fn new(degree: SplineDegree, origin: [f64; D], h: f64) -> Result<Self, MpmError> {
        check_placement(&origin, h)?;
        Ok(Self {
            degree,
            nodes: UniformGrid::new(origin, h),
            numbers: NodeNumbers::default(),
            bases: Vec::new(),
            stencils: Vec::new(),
            schedule: Schedule::default(),
        })
    }

    fn width(&self) -> usize {
        self.degree.width()
    }

    /// Of D_p, per area; `None` where ∇w_ip stands for w_ip D_p⁻¹ (x_i − x_p).
    fn inverse_second_moment(&self) -> Option<f64> {
        let h = self.nodes.spacing();
        self.degree.second_moment().map(|moment| 1.0 / (moment * h * h))
    }

    fn rows(&self, x: &[f64; D]) -> Rows<D> {
        Rows::of(self.degree, &self.nodes, x)
    }

    /// The nodes of the stencil that begins at `base`, the last axis fastest.
    fn stencil(&self, base: [i32; D]) -> impl Iterator<Item = [i32; D]> {
        let width = self.width() as i32;
        let mut place = [0; D];
        (0..self.stencil_size()).map(move |_| {
            let node = std::array::from_fn(|a| base[a] + place[a]);
            advance(&mut place, width);
            node
        })
    }
}

impl<const D: usize> Basis<D> for ProductGrid<D> {
    const LONE_PARTICLES: bool = true;
    type Cell = ();

    /// By first nodes, the last axis fastest.
    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.schedule.clear();
        self.bases.clear();
        for (particle, x) in positions.iter().enumerate() {
            let base = self
                .degree
                .first_node(&self.nodes, x)
                .ok_or_else(|| MpmError::PositionOutOfRange {
                    particle,
                    position: x.to_vec(),
                    spacing: self.nodes.spacing(),
                })?;
            self.bases.push(base);
        }
        let count = positions.len() as u32;
        self.schedule.keeps_order = self.bases.is_sorted();
        self.schedule.order.extend(0..count);
        if !self.schedule.keeps_order {
            self.schedule
                .order
                .sort_by_key(|&particle| self.bases[particle as usize]);
            self.bases.sort_unstable();
        }
        self.schedule.cell_starts.extend(0..=count);
        self.schedule.lone_particles = true;
        Ok(())
    }

    fn activate(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        let size = self.stencil_size();
        let stored = sorted.len().saturating_mul(size) <= MOST_STORED;
        let mut numbers = std::mem::take(&mut self.numbers);
        let mut stencils = std::mem::take(&mut self.stencils);
        numbers.clear(&self.bases, self.width());
        stencils.clear();
        let mut offsets = Vec::new();
        if let (NodeNumbers::Boxed(own), Some(&base)) = (&mut numbers, self.bases.first()) {
            offsets = own.offsets(&base, self.stencil(base));
            own.count(&self.bases, &offsets);
        }
        self.schedule.cut(size);
        for part in 0..self.schedule.parts.len() {
            let (mut low, mut high) = (u32::MAX, 0);
            let mut meet = |number: u32| {
                (low, high) = (low.min(number), high.max(number));
                if stored {
                    stencils.push(number);
                }
            };
            for particle in self.schedule.parts[part].cells.clone() {
                let base = self.bases[particle];
                match &mut numbers {
                    NodeNumbers::Boxed(own) => {
                        let first = own.place(&base);
                        offsets.iter().for_each(|offset| meet(own.number(first + offset)));
                    }
                    NodeNumbers::Hashed(map) => self.stencil(base).for_each(|node| meet(map.number(node))),
                }
                if numbers.len() > u32::MAX as usize - size {
                    let nodes = numbers.len() as u64;
                    return Err(MpmError::TooManyNodes { nodes });
                }
            }
            self.schedule.parts[part].nodes = low as usize..high as usize + 1;
        }
        (self.numbers, self.stencils) = (numbers, stencils);
        self.schedule.join(self.numbers.len());
        Ok(())
    }

    fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    fn node_count(&self) -> usize {
        self.numbers.len()
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        out.extend(self.numbers.nodes().map(|node| self.nodes.node_position(&node)));
    }

    fn spacing(&self) -> f64 {
        self.nodes.spacing()
    }

    fn stencil_size(&self) -> usize {
        self.width().pow(D as u32)
    }

    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        let size = self.stencil_size();
        if !self.stencils.is_empty() {
            return &self.stencils[cell * size..][..size];
        }
        scratch.clear();
        let numbers = self.stencil(self.bases[cell]);
        scratch.extend(numbers.map(|node| self.numbers.find(&node).unwrap_or(crate::NO_NODE)));
        scratch
    }

    /// In a row along the last axis weight and gradient of a node are those of the row times N, but for ∂w/∂x_D.
    #[inline]
    fn for_each_node(&self, _: usize, x: &[f64; D], mut visit: impl FnMut(usize, &Entry<D>)) {
        let (h, last, rows) = (self.spacing(), D - 1, self.rows(x));
        rows.for_each(|first, row| {
            let mut entry = *row;
            for j in 0..self.width() {
                let (weight, derivative) = (rows.weights[last][j], rows.derivatives[last][j]);
                for a in 0..last {
                    entry.gradient[a] = row.gradient[a] * weight;
                }
                entry.gradient[last] = row.weight * derivative;
                entry.weight = row.weight * weight;
                entry.offset[last] = rows.offsets[last] + h * j as f64;
                visit(first + j, &entry);
            }
        });
    }

    #[inline]
    fn deposit<A: Columns<D>, S: Columns<D>>(
        &self,
        Member { x, .. }: Member<(), D>,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        let (h, last, inverse) = (self.spacing(), D - 1, self.inverse_second_moment());
        let rows = self.rows(x);
        rows.for_each(|first, row| {
            let mut of_row = value.combine(row.weight, &Deposit::ZERO, 0.0);
            for a in 0..last {
                let direction = inverse.map_or(row.gradient[a], |inverse| row.weight * row.offset[a] * inverse);
                for (column, scale) in [(affine.column(a), direction), (flux.column(a), row.gradient[a])] {
                    add_column(&mut of_row.vector, scale, column);
                }
            }
            // What goes with N r and with N′ along the row.
            let (mut tilt, mut slope) = ([0.0; D], [0.0; D]);
            match inverse {
                Some(inverse) => add_column(&mut tilt, row.weight * inverse, affine.column(last)),
                None => add_column(&mut slope, row.weight, affine.column(last)),
            }
            add_column(&mut slope, row.weight, flux.column(last));
            for j in 0..self.width() {
                let (weight, derivative) = (rows.weights[last][j], rows.derivatives[last][j]);
                let reach = weight * (rows.offsets[last] + h * j as f64);
                let mut deposit = Deposit::ZERO.combine(0.0, &of_row, weight);
                for a in 0..D {
                    let along = multiply_add(reach, tilt[a], derivative * slope[a]);
                    deposit.vector[a] += along;
                }
                sink.add(first + j, &deposit);
            }
        });
    }

    #[inline]
    fn interpolate(
        &self,
        Member { x, .. }: Member<(), D>,
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        let (mut sum, h, last) = (Interpolated::ZERO, self.spacing(), D - 1);
        let by_moment = self
            .inverse_second_moment()
            .filter(|_| wanted.gradient && wanted.least_squares);
        let with_slope = wanted.gradient && by_moment.is_none();
        let with_moment = wanted.moment || by_moment.is_some();
        let rows = self.rows(x);
        rows.for_each(|first, row| {
            // Σ N v, Σ N′ v and Σ N r v along the row.
            let (mut value, mut slope, mut reach) = ([0.0; D], [0.0; D], [0.0; D]);
            for j in 0..self.width() {
                let (v, weight) = (nodes.vector(first + j), rows.weights[last][j]);
                add_scaled(&mut value, weight, &v);
                if with_slope {
                    add_scaled(&mut slope, rows.derivatives[last][j], &v);
                }
                if with_moment {
                    add_scaled(&mut reach, weight * (rows.offsets[last] + h * j as f64), &v);
                }
            }
            add_scaled(&mut sum.value, row.weight, &value);
            if with_slope {
                let slope = slope.map(|c| row.weight * c);
                add_row(&mut sum.gradient, &value, &row.gradient, &slope);
            }
            if with_moment {
                let offsets = row.offset.map(|r| row.weight * r);
                let reach = reach.map(|c| row.weight * c);
                add_row(&mut sum.moment, &value, &offsets, &reach);
            }
        });
        if let Some(inverse) = by_moment {
            sum.gradient = sum.moment * inverse;
        }
        if !wanted.moment {
            sum.moment = Matrix::ZERO;
        }
        sum
    }

    fn affine_direction(&self, _: usize, _: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        self.inverse_second_moment().map_or(entry.gradient, |inverse| {
            entry.offset.map(|r| entry.weight * r * inverse)
        })
    }

    fn storage_bytes(&self) -> usize {
        self.numbers.storage_bytes()
            + self.bases.capacity() * size_of::<[i32; D]>()
            + self.stencils.capacity() * 4
            + self.schedule.storage_bytes()
    }
}

impl<const D: usize> UniformBasis<D> for ProductGrid<D> {
    fn place(&mut self, origin: [f64; D], h: f64) -> Result<(), MpmError> {
        self.nodes = placed_grid(origin, h)?;
        Ok(())
    }

    fn cell_point(&self, fraction: &[f64; D], h: f64) -> [f64; D] {
        fraction.map(|c| c * h)
    }
}
