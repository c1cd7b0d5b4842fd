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
/// node numbers of its cell. `data` is cut between groups, so that threads never share a particle.
pub fn gather<const D: usize, B, V>(basis: &B, data: V, update: &(impl Fn(&mut V, usize, usize, &[u32]) + Sync))
where
    B: Basis<D>,
    V: Divide,
{
    let schedule = basis.schedule();
    if schedule.group_count() > 0 {
        gather_groups(basis, 0..schedule.group_count(), data, update);
    }
}

fn gather_groups<const D: usize, B, V>(
    basis: &B,
    groups: Range<usize>,
    mut data: V,
    update: &(impl Fn(&mut V, usize, usize, &[u32]) + Sync),
) where
    B: Basis<D>,
    V: Divide,
{
    let schedule = basis.schedule();
    let first = schedule.group_particles(groups.start).start;
    let end = schedule.group_particles(groups.end - 1).end;
    let several_threads = rayon::current_num_threads() > 1;
    if several_threads && groups.len() > 1 && (end - first) * basis.stencil_size() > PARALLEL_THRESHOLD {
        let middle = groups.start + groups.len() / 2;
        let (left, right) = data.divide(schedule.group_particles(middle).start - first);
        rayon::join(
            || gather_groups(basis, groups.start..middle, left, update),
            || gather_groups(basis, middle..groups.end, right, update),
        );
        return;
    }
    let mut cell_nodes = Vec::new();
    for group in groups {
        for cell in schedule.group(group) {
            basis.cell_nodes(cell, &mut cell_nodes);
            let cell_nodes = &cell_nodes[..basis.stencil_size()]; // a constant length: no check per node
            for particle in schedule.cell(cell) {
                update(&mut data, particle - first, particle, cell_nodes);
            }
        }
    }
}
