//! A block with the nodes around it that stencils with their base in it touch: their numbers lie in one table per block, from which
//! a cell copies its rows.

use super::block::{edge_bits, locate, node_at, reach};

/// Tables of more places than this would hold many that no particle touches.
const LARGEST: usize = 512;

/// Geometry of the table of stencils with `width` nodes per axis; the same for all blocks.
#[derive(Clone, Debug)]
pub struct Halo {
    /// (slot, place in the block) of every node of the table.
    pub nodes: Vec<(u16, u8)>,
    /// Place in the table of the base of every cell.
    pub bases: Vec<u16>,
    /// Places in the table of a stencil's rows along the last axis, from its base.
    pub rows: Vec<u16>,
}

/// Whether tables are worth their storage.
pub const fn has_halo<const D: usize>(width: usize) -> bool {
    let bits = edge_bits::<D>();
    let mut size = 1;
    let mut axis = 0;
    while axis < D {
        size *= (1 << bits[axis]) + width - 1;
        axis += 1;
    }
    size <= LARGEST
}

impl Halo {
    pub fn new<const D: usize>(width: usize) -> Self {
        let (bits, reach) = (edge_bits::<D>(), reach::<D>(width));
        let edges = bits.map(|bits| (1usize << bits) + width - 1);
        let size = edges.iter().product();
        let place = |node: &[i32; D]| (0..D).fold(0, |place, a| place * edges[a] + node[a] as usize);
        let nodes = (0..size).map(|index| {
            let (block, local) = locate(&super::template::digits(index, &edges).map(|digit| digit as i32));
            let slot = (0..D).fold(0, |slot, a| slot * reach[a] + block[a] as usize);
            (slot as u16, local as u8)
        });
        let mut row_edges = [width; D];
        row_edges[D - 1] = 1;
        let rows = 0..row_edges.iter().product();
        let row = |index| place(&super::template::digits(index, &row_edges).map(|digit| digit as i32)) as u16;
        Self {
            nodes: nodes.collect(),
            bases: (0..64).map(|cell| place(&node_at::<D>(&[0; D], cell)) as u16).collect(),
            rows: rows.map(row).collect(),
        }
    }

    pub fn storage_bytes(&self) -> usize {
        self.nodes.capacity() * 4 + (self.bases.capacity() + self.rows.capacity()) * 2
    }
}
