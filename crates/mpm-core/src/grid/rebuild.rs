//! The rebuild: from positions to cells, active nodes and parts.

use mpm_kernels::Spline;

use super::block::locate;
use super::{Scratch, SplineGrid};
use crate::counting_sort::counting_sort;
use crate::{Basis, MpmError, Schedule};

/// Grid coordinates beyond ±2³⁰ are refused.
const COORDINATE_LIMIT: f64 = (1u64 << 30) as f64;

/// A block number and a place in the block share 32 bits.
const BLOCK_LIMIT: u32 = 1 << 26;

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Phase 1 of the rebuild (sort): the block and the cell of every particle.
    pub(super) fn locate_particles(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.particle_blocks.clear();
        let keys = &mut self.scratch.keys;
        keys.clear();
        keys.reserve(positions.len());
        let nodes = self.nodes;
        let mut last = ([i32::MAX; D], 0);
        for (particle, x) in positions.iter().enumerate() {
            let u: [f64; D] = std::array::from_fn(|a| nodes.coordinate(x, a));
            if !u.iter().all(|u| u.abs() < COORDINATE_LIMIT) {
                return Err(MpmError::PositionOutOfRange {
                    particle,
                    position: x.to_vec(),
                    spacing: nodes.spacing(),
                });
            }
            let (block, place) = locate(&u.map(|u| S::row(u).base));
            if block != last.0 {
                last = (block, self.particle_blocks.number(block));
                if last.1 >= BLOCK_LIMIT {
                    let nodes = u64::from(last.1); // every block of particles has a node of its own: a stencil's base
                    return Err(MpmError::TooManyNodes { nodes });
                }
            }
            keys.push((last.1 << 6) | place);
        }
        Ok(())
    }

    /// Phase 2 (sort): counting sort of the particles by (block in lexicographic order, cell).
    pub(super) fn sort_particles(&mut self) {
        let Scratch {
            keys,
            sorted_blocks,
            ranks,
            bin_starts,
            cursors,
        } = &mut self.scratch;
        let blocks = self.particle_blocks.keys();
        sorted_blocks.clear();
        sorted_blocks.extend(0..blocks.len() as u32);
        sorted_blocks.sort_unstable_by_key(|&number| blocks[number as usize]);
        ranks.clear();
        ranks.resize(blocks.len(), 0);
        for (rank, &number) in sorted_blocks.iter().enumerate() {
            ranks[number as usize] = rank as u32;
        }
        for key in keys.iter_mut() {
            *key = (ranks[(*key >> 6) as usize] << 6) | (*key & 63);
        }
        let Schedule { order, cell_starts, .. } = &mut self.schedule;
        counting_sort(keys, blocks.len() * 64, bin_starts, order, cursors);
        cell_starts.clear();
        self.block_cells.clear();
        self.cell_places.clear();
        self.cell_blocks.clear();
        for (bin, range) in bin_starts.windows(2).enumerate() {
            if bin % 64 == 0 {
                self.block_cells.push(cell_starts.len() as u32);
            }
            if range[0] < range[1] {
                cell_starts.push(range[0]);
                self.cell_places.push((bin % 64) as u8);
                self.cell_blocks.push((bin / 64) as u32);
            }
        }
        self.block_cells.push(cell_starts.len() as u32);
        cell_starts.push(order.len() as u32);
    }

    /// Phase 3 (activate): activate and number the nodes that the occupied cells touch.
    pub(super) fn activate_nodes(&mut self) -> Result<(), MpmError> {
        self.node_blocks.clear();
        self.masks.clear();
        let slots = self.template.neighbours.len();
        self.neighbours.clear();
        self.neighbours
            .resize(self.scratch.sorted_blocks.len() * slots, u32::MAX);
        let mut touched = vec![0u64; slots];
        for (rank, &number) in self.scratch.sorted_blocks.iter().enumerate() {
            touched.fill(0);
            for cell in self.block_cells[rank] as usize..self.block_cells[rank + 1] as usize {
                for &(slot, mask) in self.template.touched(u32::from(self.cell_places[cell])) {
                    touched[slot as usize] |= mask;
                }
            }
            let home = self.particle_blocks.keys()[number as usize];
            let row = &mut self.neighbours[rank * slots..][..slots];
            for ((&mask, offset), neighbour) in touched.iter().zip(&self.template.neighbours).zip(row) {
                if mask != 0 {
                    let block = std::array::from_fn(|a| home[a] + offset[a]);
                    *neighbour = self.node_blocks.number(block);
                    let index = *neighbour as usize;
                    if index == self.masks.len() {
                        self.masks.push(0);
                    }
                    self.masks[index] |= mask;
                }
            }
        }
        self.first_nodes.clear();
        let mut count = 0u64;
        for mask in &self.masks {
            self.first_nodes.push(count as u32);
            count += u64::from(mask.count_ones());
        }
        self.first_nodes.push(count as u32);
        if count > u64::from(u32::MAX) {
            return Err(MpmError::TooManyNodes { nodes: count });
        }
        Ok(())
    }

    /// Phase 4 (activate): cut the cells into parts.
    pub(super) fn divide_cells(&mut self) {
        let slots = self.template.neighbours.len();
        let (neighbours, first_nodes, cell_blocks) = (&self.neighbours, &self.first_nodes, &self.cell_blocks);
        let (size, count) = (self.stencil_size(), self.node_count());
        self.schedule.cut(size);
        for part in &mut self.schedule.parts {
            let blocks = cell_blocks[part.cells.start] as usize..cell_blocks[part.cells.end - 1] as usize + 1;
            let touched = neighbours[blocks.start * slots..blocks.end * slots].iter();
            let touched = touched.filter(|&&block| block != u32::MAX);
            let ends = touched.fold((u32::MAX, 0), |(low, high), &block| (low.min(block), high.max(block)));
            part.nodes = first_nodes[ends.0 as usize] as usize..first_nodes[ends.1 as usize + 1] as usize;
        }
        self.schedule.join(count);
    }
}
