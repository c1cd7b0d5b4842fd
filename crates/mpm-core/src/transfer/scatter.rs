//! Particles → nodes: every particle adds to the nodes of its stencil, in an order that no thread count changes.

use std::ops::Range;

use mpm_kernels::Lanes;
use mpm_parallel::each;

use super::ahead::{Ahead, Prepare};
use super::{CellSums, GridNode};
use crate::{Basis, Member, Part, Schedule};

/// Sums that several parts of the particles contribute to.
pub trait Sum: Copy + Default + Send + Sync {
    /// Add another part's sum.
    fn merge(&mut self, other: &Self);
}

impl Sum for f64 {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        *self += other;
    }
}

/// Cells whose particles add to nodes, the number of the first of these, and these.
type Share<'a, N> = (Range<usize>, usize, &'a mut [N]);

/// Nodes of one piece of work when the parts' sums are added.
const MERGE_LENGTH: usize = 1 << 12;

/// What the cells of a part leave to each other.
struct Memory<C, I> {
    collected: C,
    lanes: Vec<Lanes>,
    ahead: Ahead<I>,
}

impl<C: Default, I> Default for Memory<C, I> {
    fn default() -> Self {
        Self {
            collected: C::default(),
            lanes: Vec::new(),
            ahead: Ahead::default(),
        }
    }
}

/// Sums at the nodes, and those of every part before they are added; the memory is kept between steps.
#[derive(Clone, Debug, Default)]
pub struct NodeSums<N> {
    nodes: Vec<N>,
    parts: Vec<N>,
}

impl<N: Sum> NodeSums<N> {
    /// One sum per active node of the basis of the last [`scatter`](Self::scatter).
    pub fn as_slice(&self) -> &[N] {
        &self.nodes
    }

    /// As [`as_slice`](Self::as_slice), mutable.
    pub fn as_mut_slice(&mut self) -> &mut [N] {
        &mut self.nodes
    }

    /// Zero at so many nodes.
    pub(crate) fn clear(&mut self, node_count: usize) {
        self.nodes.clear();
        self.nodes.resize(node_count, N::default());
    }

    /// Start from zero and call `deposit(p, x_p, stencil)` for every particle p (schedule order); it adds to the nodes of
    /// the particle's stencil. `positions` are in schedule order.
    ///
    /// Every part of the schedule adds up its own nodes; a single part does so in place.
    pub fn scatter<const D: usize, B: Basis<D>>(
        &mut self,
        basis: &B,
        positions: &[[f64; D]],
        deposit: impl Fn(usize, &[f64; D], &mut StencilNodes<N>) + Sync + Copy,
    ) {
        self.scatter_cells(basis, move |_, particles, stencil, _: &mut ()| {
            for particle in particles {
                deposit(particle, &positions[particle], stencil);
            }
        });
    }

    /// As [`scatter`](Self::scatter), for sums with lanes: `deposit(p, I, sums)` adds to the sums of a cell, which are added to the nodes
    /// once per cell. Bases with lone particles have no use for them; there the sums are the nodes themselves.
    ///
    /// I is what `source` has prepared for the particle, some particles ahead at a time; `None` where nothing is wanted of it.
    pub(crate) fn scatter_packed<const D: usize, B: Basis<D>, P: Prepare>(
        &mut self,
        basis: &B,
        positions: &[[f64; D]],
        with_impulses: bool,
        source: P,
        deposit: impl Fn(Member<B::Cell, D>, Option<&P::Value>, &mut CellSums<B, N, D>) + Sync + Copy,
    ) where
        N: GridNode<D>,
    {
        self.scatter_cells(
            basis,
            move |cell, particles, stencil, memory: &mut Memory<B::Cell, P::Value>| {
                basis.enter(cell, &mut memory.collected);
                if P::WANTED {
                    memory.ahead.reach(&particles, positions.len(), &source);
                }
                let alone = particles.len() == 1;
                let mut sums = CellSums::<B, N, D>::new(stencil, &mut memory.lanes, with_impulses, alone);
                for particle in particles {
                    let prepared = if P::WANTED { memory.ahead.get(particle) } else { None };
                    let member = Member {
                        cell: &memory.collected,
                        particle,
                        x: &positions[particle],
                    };
                    deposit(member, prepared, &mut sums);
                }
                sums.close();
            },
        );
    }

    /// Start from zero and call `add(cell, particles, stencil, memory)` for every cell.
    pub(crate) fn scatter_cells<const D: usize, B: Basis<D>, S: Default>(
        &mut self,
        basis: &B,
        add: impl Fn(usize, Range<usize>, &mut StencilNodes<N>, &mut S) + Sync + Copy,
    ) {
        let schedule = basis.schedule();
        self.add_up(schedule, basis.node_count(), &|(cells, first, nodes)| {
            let (mut scratch, mut memory) = (Vec::new(), S::default());
            #[expect(
                clippy::redundant_locals,
                reason = "a copy of its own, so that what it captured may stay in registers"
            )]
            let add = add;
            for cell in cells {
                let mut stencil = StencilNodes {
                    numbers: &basis.cell_nodes(cell, &mut scratch)[..basis.cell_stencil_size(cell)],
                    first,
                    nodes,
                };
                add(cell, schedule.cell(cell), &mut stencil, &mut memory);
            }
        });
    }

    /// Let `work` add up the nodes of every part, and add the parts.
    fn add_up(&mut self, schedule: &Schedule, node_count: usize, work: &(dyn Fn(Share<N>) + Sync)) {
        self.clear(node_count);
        if let [part] = schedule.parts() {
            work((part.cells.clone(), 0, &mut self.nodes));
            return;
        }
        let stored = schedule.parts().iter().map(|part| part.nodes.len()).sum();
        self.parts.resize(stored, N::default());
        let mut parts = Vec::with_capacity(schedule.parts().len());
        let mut rest = self.parts.as_mut_slice();
        for part in schedule.parts() {
            let (own, others) = rest.split_at_mut(part.nodes.len());
            parts.push((part, own));
            rest = others;
        }
        each(parts.iter_mut(), &|(part, own): &mut (&Part, &mut [N])| {
            own.fill(N::default());
            work((part.cells.clone(), part.nodes.start, own));
        });
        merge(&parts, &mut self.nodes);
    }

    /// Bytes held.
    pub fn storage_bytes(&self) -> usize {
        (self.nodes.capacity() + self.parts.capacity()) * size_of::<N>()
    }
}

/// Add the sums of all parts.
fn merge<N: Sum>(parts: &[(&Part, &mut [N])], nodes: &mut [N]) {
    each(nodes.chunks_mut(MERGE_LENGTH).enumerate(), &|(chunk, nodes)| {
        let begin = chunk * MERGE_LENGTH;
        for (part, own) in parts {
            let shared = part.nodes.start.max(begin)..part.nodes.end.min(begin + nodes.len());
            if !shared.is_empty() {
                let from = &own[shared.start - part.nodes.start..shared.end - part.nodes.start];
                for (node, sum) in nodes[shared.start - begin..].iter_mut().zip(from) {
                    node.merge(sum);
                }
            }
        }
    });
}

/// The nodes of one cell's stencils.
pub struct StencilNodes<'a, N> {
    pub(super) numbers: &'a [u32],
    /// Number of the first of `nodes`.
    first: usize,
    nodes: &'a mut [N],
}

impl<N> StencilNodes<'_, N> {
    /// The node at a place of the stencil, as counted by [`Basis::for_each_node`].
    #[inline(always)]
    pub fn node(&mut self, index: usize) -> &mut N {
        &mut self.nodes[self.numbers[index] as usize - self.first]
    }

    /// The same nodes.
    #[inline(always)]
    pub(super) fn all(&mut self) -> StencilNodes<'_, N> {
        self.part(0, self.numbers.len())
    }

    /// The nodes at `length` places from `first` on.
    #[inline(always)]
    pub(super) fn part(&mut self, first: usize, length: usize) -> StencilNodes<'_, N> {
        StencilNodes {
            numbers: &self.numbers[first..first + length],
            first: self.first,
            nodes: &mut *self.nodes,
        }
    }

    /// Places of the stencil.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Every node that a particle of the cell touches, with what `others` has for its place.
    #[inline(always)]
    pub(crate) fn for_each_with<T>(&mut self, others: impl Iterator<Item = T>, mut visit: impl FnMut(&mut N, T)) {
        // By value, so that what is written to the nodes cannot change where they are.
        let (numbers, first, nodes) = (self.numbers, self.first, &mut *self.nodes);
        for (&number, other) in numbers.iter().zip(others) {
            // NO_NODE is behind them all.
            if let Some(node) = nodes.get_mut((number as usize).wrapping_sub(first)) {
                visit(node, other);
            }
        }
    }
}
