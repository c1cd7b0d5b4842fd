//! What the stencils of one kernel look like from a block; the same for all blocks.

use super::block::{digits, locate, node_at, reach, slot_count};
use super::tile::{self, has_tiles};

/// Precomputed geometry of stencils with `width` nodes per axis.
#[derive(Clone, Debug)]
pub struct Template<const D: usize> {
    /// Offsets, in blocks, of all blocks that particles of one block may touch: the slots.
    pub neighbours: Vec<[i32; D]>,
    /// (slot, place in the block) of every node of a tile; the rest is for grids without tiles, and from each of the 64 cells of a block.
    pub tile: Vec<(u16, u8)>,
    /// For each cell: (slot, mask) of every block it touches.
    touched: Vec<Vec<(u16, u64)>>,
    /// The segments of all cells, and the number of the first one of every cell.
    segments: Vec<Segment>,
    segment_starts: Vec<u32>,
}

/// Nodes that follow each other along the last axis in one block, at most `width` of them. All are active where a particle is, so
/// their numbers follow each other too.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Slot of the block.
    pub slot: u16,
    /// Place of the first node in the block.
    pub place: u8,
    /// Number of nodes.
    pub count: u8,
}

impl<const D: usize> Template<D> {
    pub fn new(width: usize) -> Self {
        if const { has_tiles::<D>() } {
            let (neighbours, tile) = tile::nodes(width);
            return Self {
                neighbours,
                tile,
                touched: Vec::new(),
                segments: Vec::new(),
                segment_starts: Vec::new(),
            };
        }
        let reach = reach::<D>(width);
        let slots = slot_count::<D>(width);
        let neighbours = (0..slots)
            .map(|slot| digits(slot, &reach).map(|digit| digit as i32))
            .collect();
        let size = width.pow(D as u32);
        let mut touched = Vec::with_capacity(64);
        let (mut segments, mut segment_starts) = (Vec::<Segment>::new(), vec![0]);
        for cell in 0..64 {
            let base = node_at(&[0; D], cell);
            let mut masks = vec![0u64; slots];
            for index in 0..size {
                let step = digits(index, &[width; D]);
                let node: [i32; D] = std::array::from_fn(|a| base[a] + step[a] as i32);
                let (block, local) = locate(&node);
                let slot = (0..D).fold(0, |slot, a| slot * reach[a] + block[a] as usize);
                masks[slot] |= 1 << local;
                match segments.last_mut() {
                    Some(last) if index % width > 0 && usize::from(last.slot) == slot => last.count += 1,
                    _ => segments.push(Segment {
                        slot: slot as u16,
                        place: local as u8,
                        count: 1,
                    }),
                }
            }
            let present = masks.into_iter().enumerate().filter(|&(_, mask)| mask != 0);
            segment_starts.push(segments.len() as u32);
            touched.push(present.map(|(slot, mask)| (slot as u16, mask)).collect());
        }
        Self {
            neighbours,
            tile: Vec::new(),
            touched,
            segments,
            segment_starts,
        }
    }

    /// (slot, mask) of every block that the stencils of `cell` touch.
    #[inline]
    pub fn touched(&self, cell: u32) -> &[(u16, u64)] {
        &self.touched[cell as usize]
    }

    /// The nodes of a stencil with its base in `cell`, the last axis fastest.
    #[inline]
    pub fn segments(&self, cell: u32) -> &[Segment] {
        let [start, end] = [cell, cell + 1].map(|cell| self.segment_starts[cell as usize] as usize);
        &self.segments[start..end]
    }

    pub fn storage_bytes(&self) -> usize {
        self.neighbours.capacity() * size_of::<[i32; D]>()
            + self.tile.capacity() * 4
            + self.segments.capacity() * size_of::<Segment>()
            + self.segment_starts.capacity() * 4
            + self.touched.iter().map(|t| t.capacity() * 16).sum::<usize>()
    }
}
