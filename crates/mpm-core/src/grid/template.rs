//! What the stencils of one kernel look like from each of the 64 cells of a block; the same for all blocks.

use super::block::{locate, node_at, reach, slot_count};

/// Precomputed geometry of stencils with `width` nodes per axis.
#[derive(Clone, Debug)]
pub struct Template<const D: usize> {
    /// Offsets, in blocks, of all blocks that a stencil may touch; slot 0 is the block of its base.
    pub neighbours: Vec<[i32; D]>,
    /// For each cell: (slot, mask) of every block it touches.
    touched: Vec<Vec<(u16, u64)>>,
    /// For each cell: (slot, place in the block) of its widthᴰ nodes.
    nodes: Vec<(u16, u16)>,
    size: usize,
}

impl<const D: usize> Template<D> {
    pub fn new(width: usize) -> Self {
        let reach = reach::<D>(width);
        let slots = slot_count::<D>(width);
        let neighbours = (0..slots)
            .map(|slot| digits(slot, &reach).map(|digit| digit as i32))
            .collect();
        let size = width.pow(D as u32);
        let mut touched = Vec::with_capacity(64);
        let mut nodes = Vec::with_capacity(64 * size);
        for cell in 0..64 {
            let base = node_at(&[0; D], cell);
            let mut masks = vec![0u64; slots];
            for index in 0..size {
                let step = digits(index, &[width; D]);
                let node: [i64; D] = std::array::from_fn(|a| base[a] + step[a] as i64);
                let (block, local) = locate(&node);
                let slot = (0..D).fold(0, |slot, a| slot * reach[a] + block[a] as usize);
                masks[slot] |= 1 << local;
                nodes.push((slot as u16, local as u16));
            }
            let present = masks.into_iter().enumerate().filter(|&(_, mask)| mask != 0);
            touched.push(present.map(|(slot, mask)| (slot as u16, mask)).collect());
        }
        Self {
            neighbours,
            touched,
            nodes,
            size,
        }
    }

    /// (slot, mask) of every block that the stencils of `cell` touch.
    #[inline]
    pub fn touched(&self, cell: u32) -> &[(u16, u64)] {
        &self.touched[cell as usize]
    }

    /// (slot, place) of the nodes of a stencil with its base in `cell`, the last axis fastest.
    #[inline]
    pub fn nodes(&self, cell: u32) -> &[(u16, u16)] {
        &self.nodes[cell as usize * self.size..][..self.size]
    }

    pub fn storage_bytes(&self) -> usize {
        self.neighbours.capacity() * size_of::<[i32; D]>()
            + self.nodes.capacity() * 4
            + self.touched.iter().map(|t| t.capacity() * 16).sum::<usize>()
    }
}

/// Digits of `number` in the mixed radix `radix`, the last fastest.
fn digits<const D: usize>(number: usize, radix: &[usize; D]) -> [usize; D] {
    let mut rest = number;
    let mut digits = [0; D];
    for a in (0..D).rev() {
        digits[a] = rest % radix[a];
        rest /= radix[a];
    }
    digits
}
