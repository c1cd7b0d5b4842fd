//! Node numbers: of a place in a block, and of a cell.

use mpm_kernels::{Spline, Stencil};

use super::SplineGrid;
use super::tile::{self, has_tiles, members, words};
use crate::NO_NODE;

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
        if const { has_tiles::<D>() } {
            return self.look_up_tile(cell, scratch);
        }
        // Four numbers are written at once; the next ones overwrite those that are too many.
        const { assert!(W <= 4, "four numbers at once") }
        let (size, key) = (Stencil::<W, D>::SIZE, self.cell_keys[cell]);
        let (rank, place) = ((key >> 6) as usize, key & 63);
        scratch.resize(size + 4, 0);
        let mut end = 0;
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

    /// The node numbers of a tile.
    fn look_up_tile<'a>(&self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        let (slots, words) = (self.template.neighbours.len(), words::<D>(W));
        let row = &self.neighbours[self.cell_keys[cell] as usize * slots..][..slots];
        scratch.clear();
        scratch.resize(tile::size::<D>(W), NO_NODE);
        for place in members(&self.touched[cell * words..][..words]) {
            let (slot, local) = self.template.tile[place];
            scratch[place] = self.blocks[row[usize::from(slot)] as usize].number(local);
        }
        scratch
    }
}
