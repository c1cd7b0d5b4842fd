//! Node numbers: of a place in a block, and of a cell.

use mpm_kernels::{Spline, Stencil};

use super::SplineGrid;
use super::halo::has_halo;

/// The active nodes of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NodeBlock {
    /// Which of the 64 nodes are active.
    pub mask: u64,
    /// Number of the first active node.
    pub first: u32,
}

impl NodeBlock {
    /// Number of the active node at a place.
    #[inline(always)]
    pub fn number(self, place: u8) -> u32 {
        self.first + (self.mask & ((1u64 << place) - 1)).count_ones()
    }

    /// Number after that of the last active node.
    pub fn end(self) -> usize {
        self.first as usize + self.mask.count_ones() as usize
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// The node numbers of a cell, written to `scratch`.
    #[inline]
    pub(super) fn look_up<'a>(&self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        // Four numbers are written at once; the next ones overwrite those that are too many.
        const { assert!(W <= 4, "four numbers at once") }
        let (size, key) = (Stencil::<W, D>::SIZE, self.cell_keys[cell]);
        let (rank, place) = ((key >> 6) as usize, key & 63);
        scratch.resize(size + 4, 0);
        let mut end = 0;
        if has_halo::<D>(W) {
            let base = rank * self.halo.nodes.len() + usize::from(self.halo.bases[place as usize]);
            let (table, mut rest) = (&self.halo_numbers[base..], &mut scratch[..]);
            for &row in &self.halo.rows {
                if let (Some(to), Some(numbers)) =
                    (rest.first_chunk_mut::<4>(), table[usize::from(row)..].first_chunk())
                {
                    *to = *numbers;
                }
                rest = &mut rest[W..];
            }
            return &scratch[..size];
        }
        let slots = self.template.neighbours.len();
        let row = &self.neighbours[rank * slots..][..slots];
        for segment in self.template.segments(place) {
            let block = self.blocks[row[usize::from(segment.slot)] as usize];
            let first = block.number(segment.place);
            scratch[end..end + 4].copy_from_slice(&[first, first + 1, first + 2, first + 3]);
            end += usize::from(segment.count);
        }
        &scratch[..size]
    }
}
