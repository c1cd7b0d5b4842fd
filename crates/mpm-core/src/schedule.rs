//! Who works when: particles in cells, cells in parts.

use std::ops::Range;

/// Particles that follow each other in one cell of the basis are a cell here; stretches of cells form parts, each with the range of nodes that its cells touch. Parts
/// add to nodes of their own side by side, and their sums are added in the order of the parts, so that the sum at every
/// node is the same on any number of threads.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    pub(crate) order: Vec<u32>,
    /// First particle of every cell, and the number of particles at the end.
    pub(crate) cell_starts: Vec<u32>,
    pub(crate) parts: Vec<Part>,
    pub(crate) keeps_order: bool,
    /// Every particle is a cell of its own.
    pub(crate) lone_particles: bool,
}

/// A stretch of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The cells.
    pub cells: Range<usize>,
    /// Numbers between which all nodes lie that the cells touch.
    pub nodes: Range<usize>,
}

/// Stencil visits that are worth a part of their own.
const VISITS_PER_PART: usize = 1 << 15;

/// Stencil visits that are worth a thread, and pieces of work that a thread gets at most.
const VISITS_PER_STRETCH: usize = 1 << 14;
const STRETCHES_PER_THREAD: usize = 8;

/// Parts at most; not more than `FEW_PARTS` where they overlap.
const MOST_PARTS: usize = 16;
const FEW_PARTS: usize = 4;

impl Schedule {
    /// Particle `order[k]` of the caller is the k-th of the schedule; k itself where the schedule keeps the order.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Number of cells with particles.
    pub fn cell_count(&self) -> usize {
        self.cell_starts.len().saturating_sub(1)
    }

    /// Particles of a cell, in schedule order.
    #[inline]
    pub fn cell(&self, cell: usize) -> Range<usize> {
        if self.lone_particles {
            return cell..cell + 1;
        }
        self.cell_starts[cell] as usize..self.cell_starts[cell + 1] as usize
    }

    /// Particles of a stretch of cells.
    pub fn particles(&self, cells: &Range<usize>) -> Range<usize> {
        self.cell_starts[cells.start] as usize..self.cell_starts[cells.end] as usize
    }

    /// The parts.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The parts, for a basis to say between [`cut`](Self::cut) and [`join`](Self::join) which nodes they touch.
    pub fn parts_mut(&mut self) -> &mut [Part] {
        &mut self.parts
    }

    /// Whether the last sort left every particle where it was.
    pub fn keeps_order(&self) -> bool {
        self.keeps_order
    }

    /// Cut the cells into parts of about equally many particles, as the work is worth with `stencil_size` nodes per
    /// particle. The cut depends on the particles alone. The parts know no nodes yet.
    pub fn cut(&mut self, stencil_size: usize) {
        let worth = (self.order.len() * stencil_size / VISITS_PER_PART).clamp(1, MOST_PARTS);
        let part = |cells| Part { cells, nodes: 0..0 };
        self.parts = self.even_stretches(1 << worth.ilog2()).map(part).collect();
    }

    /// Stretches of cells for threads that share nothing, as many as the work is worth with `stencil_size` nodes per particle.
    pub(crate) fn stretches(&self, stencil_size: usize) -> Vec<Range<usize>> {
        let worth = self.order.len() * stencil_size / VISITS_PER_STRETCH;
        let count = match mpm_parallel::threads() {
            1 => 1,
            threads => worth.clamp(1, STRETCHES_PER_THREAD * threads),
        };
        self.even_stretches(count).collect()
    }

    /// At most `count` stretches of cells with about equally many particles; none is empty.
    fn even_stretches(&self, count: usize) -> impl Iterator<Item = Range<usize>> {
        let (particles, cells, mut begin) = (self.order.len(), self.cell_count(), 0);
        (1..=count).filter_map(move |k| {
            let end = self.cell_starts[..cells].partition_point(|&start| (start as usize) < k * particles / count);
            let cells = begin..end;
            begin = end;
            (!cells.is_empty()).then_some(cells)
        })
    }

    /// Join neighbouring parts, now that they know their nodes, until few are left, where the nodes that several of them
    /// have would cost more storage than the nodes themselves or half the particles.
    pub fn join(&mut self, node_count: usize) {
        let particles = self.order.len();
        let stored = |parts: &[Part]| parts.iter().map(|part| part.nodes.len()).sum::<usize>();
        while self.parts.len() > FEW_PARTS && stored(&self.parts) > node_count + node_count.max(particles / 2) {
            self.parts = self.parts.chunks(2).map(joined).collect();
        }
    }

    /// Nothing to do, until the next sort has gone through.
    pub(crate) fn clear(&mut self) {
        self.order.clear();
        self.cell_starts.clear();
        self.parts.clear();
        self.keeps_order = false;
    }

    /// Bytes held.
    pub fn storage_bytes(&self) -> usize {
        (self.order.capacity() + self.cell_starts.capacity()) * 4 + self.parts.capacity() * size_of::<Part>()
    }
}

/// One part for a pair of neighbours, or for one that has none.
fn joined(pair: &[Part]) -> Part {
    let (first, last) = (&pair[0], &pair[pair.len() - 1]);
    Part {
        cells: first.cells.start..last.cells.end,
        nodes: first.nodes.start.min(last.nodes.start)..first.nodes.end.max(last.nodes.end),
    }
}
