//! Nodes → particles: every particle reads the nodes of its stencil.

use std::ops::Range;

use crate::{Basis, Schedule};

/// A cell of a schedule at work.
pub(crate) struct CellWork<'a> {
    /// Its place in the schedule.
    pub cell: usize,
    pub particles: Range<usize>,
    /// Numbers of its nodes.
    pub nodes: &'a [u32],
}

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
    gather_cells(basis, data, move |data, work, first, _: &mut ()| {
        for p in work.particles {
            update(data, p - first, p, work.nodes);
        }
    });
}

/// Call `update(data, cell, first, memory)` for every cell: `data` begins with particle `first`, and `memory` is
/// what the cells before have left.
pub(crate) fn gather_cells<const D: usize, B, V, S: Default>(
    basis: &B,
    data: V,
    update: impl Fn(&mut V, CellWork, usize, &mut S) + Sync + Send + Copy,
) where
    B: Basis<D>,
    V: Divide,
{
    let work = |(cells, data)| gather_stretch(basis, cells, data, update);
    divided(basis.schedule(), basis.stencil_size(), data, &work);
}

/// Hand every stretch of cells the data of its particles.
fn divided<V: Divide>(schedule: &Schedule, stencil_size: usize, data: V, work: &(dyn Fn((Range<usize>, V)) + Sync)) {
    let (mut pieces, mut rest) = (Vec::new(), data);
    for cells in schedule.stretches(stencil_size) {
        let (own, others) = rest.divide(schedule.particles(&cells).len());
        pieces.push((cells, own));
        rest = others;
    }
    mpm_parallel::each(pieces.into_iter(), work);
}

fn gather_stretch<const D: usize, B, V, S: Default>(
    basis: &B,
    cells: Range<usize>,
    mut data: V,
    update: impl Fn(&mut V, CellWork, usize, &mut S),
) where
    B: Basis<D>,
{
    let schedule = basis.schedule();
    let first = schedule.particles(&cells).start;
    let (mut scratch, mut memory) = (Vec::new(), S::default());
    for cell in cells {
        let work = CellWork {
            cell,
            particles: schedule.cell(cell),
            nodes: &basis.cell_nodes(cell, &mut scratch)[..basis.cell_stencil_size(cell)], // no check per node
        };
        update(&mut data, work, first, &mut memory);
    }
}
