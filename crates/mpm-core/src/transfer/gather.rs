//! Nodes → particles: every particle reads the nodes of its stencil.

use std::ops::Range;

use crate::Basis;

/// Below this many stencil visits a part of the particles is worked off by one thread.
const PARALLEL_THRESHOLD: usize = 1 << 14;

/// Mutable per-particle data that can be cut in two at a particle.
pub trait Divide: Sized + Send {
    /// The data of the first `count` particles, and the rest.
    fn divide(self, count: usize) -> (Self, Self);
}

impl<T: Send> Divide for &mut [T] {
    fn divide(self, count: usize) -> (Self, Self) {
        let count = count.min(self.len()); // a field that does not exist is empty
        self.split_at_mut(count)
    }
}

/// Call `update(data, k, p, cell_nodes)` for every particle p (schedule order): k is its place in `data`, `cell_nodes` the
/// node numbers of its cell. `data` is cut between cells, so that threads never share a particle.
pub fn gather<const D: usize, B, V>(
    basis: &B,
    data: V,
    update: impl Fn(&mut V, usize, usize, &[u32]) + Sync + Send + Copy,
) where
    B: Basis<D>,
    V: Divide,
{
    gather_cells(basis, data, move |data, particles, cell_nodes, first, _: &mut ()| {
        for p in particles {
            update(data, p - first, p, cell_nodes);
        }
    });
}

/// Call `update(data, particles, cell_nodes, first, memory)` for every cell: `data` begins with particle `first`, and `memory` is
/// what the cells before have left.
pub(crate) fn gather_cells<const D: usize, B, V, S: Default>(
    basis: &B,
    data: V,
    update: impl Fn(&mut V, Range<usize>, &[u32], usize, &mut S) + Sync + Send + Copy,
) where
    B: Basis<D>,
    V: Divide,
{
    gather_stretch(basis, 0..basis.schedule().cell_count(), data, update);
}

fn gather_stretch<const D: usize, B, V, S: Default>(
    basis: &B,
    cells: Range<usize>,
    mut data: V,
    update: impl Fn(&mut V, Range<usize>, &[u32], usize, &mut S) + Sync + Send + Copy,
) where
    B: Basis<D>,
    V: Divide,
{
    if cells.is_empty() {
        return;
    }
    let schedule = basis.schedule();
    let particles = schedule.particles(&cells);
    let worth_two = particles.len() * basis.stencil_size() > PARALLEL_THRESHOLD;
    if worth_two && cells.len() > 1 && rayon::current_num_threads() > 1 {
        let middle = cells.start + cells.len() / 2;
        let (left, right) = data.divide(schedule.cell(middle).start - particles.start);
        rayon::join(
            || gather_stretch(basis, cells.start..middle, left, update),
            || gather_stretch(basis, middle..cells.end, right, update),
        );
        return;
    }
    let (mut scratch, mut memory) = (Vec::new(), S::default());
    for cell in cells {
        let cell_nodes = &basis.cell_nodes(cell, &mut scratch)[..basis.cell_stencil_size(cell)]; // no check per node
        update(&mut data, schedule.cell(cell), cell_nodes, particles.start, &mut memory);
    }
}
