//! Who works when: particles in cells, cells in groups, groups in colours.

use std::ops::Range;

/// The layout of a step: particles are sorted by cell; neighbouring cells form groups; the groups of one colour touch
/// disjoint sets of nodes, so that they may add to the nodes side by side, and the sum at every node is taken in the same
/// order on any number of threads.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    pub(crate) order: Vec<u32>,
    /// First particle of every cell, and the number of particles at the end.
    pub(crate) cell_starts: Vec<u32>,
    /// First cell of every group, and the number of cells at the end.
    pub(crate) group_starts: Vec<u32>,
    /// Groups sorted by colour.
    pub(crate) coloured_groups: Vec<u32>,
    /// First entry of every colour in `coloured_groups`, and their number at the end.
    pub(crate) colour_starts: Vec<u32>,
}

impl Schedule {
    /// A schedule from its parts: `order` as in [`order`](Self::order); the first particle of every cell; the first cell of
    /// every group; the groups sorted by colour; the first of them for every colour. Each `starts` ends with the total.
    ///
    /// What the colours have to satisfy is part of the contract of [`Basis`](crate::Basis).
    pub fn new(
        order: Vec<u32>,
        cell_starts: Vec<u32>,
        group_starts: Vec<u32>,
        coloured_groups: Vec<u32>,
        colour_starts: Vec<u32>,
    ) -> Self {
        Self {
            order,
            cell_starts,
            group_starts,
            coloured_groups,
            colour_starts,
        }
    }

    /// Particle `order[k]` of the caller is the k-th of the schedule.
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
        self.cell_starts[cell] as usize..self.cell_starts[cell + 1] as usize
    }

    /// Number of groups.
    pub fn group_count(&self) -> usize {
        self.group_starts.len().saturating_sub(1)
    }

    /// Cells of a group.
    #[inline]
    pub fn group(&self, group: usize) -> Range<usize> {
        self.group_starts[group] as usize..self.group_starts[group + 1] as usize
    }

    /// Particles of a group.
    pub fn group_particles(&self, group: usize) -> Range<usize> {
        let cells = self.group(group);
        self.cell_starts[cells.start] as usize..self.cell_starts[cells.end] as usize
    }

    /// Groups of every colour.
    pub fn colours(&self) -> impl Iterator<Item = &[u32]> {
        self.colour_starts
            .windows(2)
            .map(|w| &self.coloured_groups[w[0] as usize..w[1] as usize])
    }

    pub(crate) fn storage_bytes(&self) -> usize {
        let vectors = [
            &self.order,
            &self.cell_starts,
            &self.group_starts,
            &self.coloured_groups,
            &self.colour_starts,
        ];
        vectors.iter().map(|v| v.capacity() * 4).sum()
    }
}
