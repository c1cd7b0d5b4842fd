//! The rebuild, phases 3 and 4: active nodes and parts.

use mpm_kernels::Spline;
use rayon::prelude::*;

use super::SplineGrid;
use super::halo::has_halo;
use super::lookup::NodeBlock;
use crate::{Basis, MpmError};

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Phase 3 (activate): activate and number the nodes that the occupied cells touch.
    pub(super) fn activate_nodes(&mut self) -> Result<(), MpmError> {
        self.node_blocks.clear();
        self.blocks.clear();
        let slots = self.template.neighbours.len();
        self.neighbours.clear();
        self.neighbours.resize(self.sorted_blocks.len() * slots, u32::MAX);
        let mut touched = vec![0u64; slots];
        for (rank, &number) in self.sorted_blocks.iter().enumerate() {
            touched.fill(0);
            let mut places = self.occupied[rank];
            while places != 0 {
                for &(slot, mask) in self.template.touched(places.trailing_zeros()) {
                    touched[slot as usize] |= mask;
                }
                places &= places - 1;
            }
            let home = self.particle_blocks.keys()[number as usize];
            let row = &mut self.neighbours[rank * slots..][..slots];
            for ((&mask, offset), neighbour) in touched.iter().zip(&self.template.neighbours).zip(row) {
                if mask != 0 {
                    let block = std::array::from_fn(|a| home[a] + offset[a]);
                    *neighbour = self.node_blocks.number(block);
                    let index = *neighbour as usize;
                    if index == self.blocks.len() {
                        self.blocks.push(NodeBlock::default());
                    }
                    self.blocks[index].mask |= mask;
                }
            }
        }
        let mut count = 0u64;
        for block in &mut self.blocks {
            block.first = count as u32;
            count += u64::from(block.mask.count_ones());
        }
        self.node_count = count as usize;
        if count > u64::from(u32::MAX) {
            return Err(MpmError::TooManyNodes { nodes: count });
        }
        if has_halo::<D>(W) {
            self.number_halos();
        }
        Ok(())
    }

    /// The node numbers of every block with particles, and around it.
    fn number_halos(&mut self) {
        let (size, slots) = (self.halo.nodes.len(), self.template.neighbours.len());
        let (halo, blocks, neighbours) = (&self.halo.nodes, &self.blocks, &self.neighbours);
        let count = self.sorted_blocks.len();
        self.halo_numbers.resize(count * size + 4, 0); // rows are read four numbers at once
        let tables = self
            .halo_numbers
            .par_chunks_exact_mut(size)
            .zip(neighbours.par_chunks_exact(slots));
        tables.with_min_len(64).for_each(|(numbers, row)| {
            for (number, &(slot, place)) in numbers.iter_mut().zip(halo) {
                let block = blocks.get(row[usize::from(slot)] as usize);
                *number = block.map_or(0, |block| block.number(place));
            }
        });
    }

    /// Phase 4 (activate): cut the cells into parts.
    pub(super) fn divide_cells(&mut self) {
        let slots = self.template.neighbours.len();
        let (neighbours, blocks, cell_keys) = (&self.neighbours, &self.blocks, &self.cell_keys);
        let (size, count) = (self.stencil_size(), self.node_count());
        self.schedule.cut(size);
        self.schedule.parts.par_iter_mut().for_each(|part| {
            let (mut last, mut ends) = (u32::MAX, (u32::MAX, 0));
            for key in &cell_keys[part.cells.clone()] {
                if key >> 6 == last {
                    continue;
                }
                last = key >> 6;
                let touched = neighbours[last as usize * slots..][..slots].iter();
                let touched = touched.filter(|&&block| block != u32::MAX);
                ends = touched.fold(ends, |(low, high), &block| (low.min(block), high.max(block)));
            }
            part.nodes = blocks[ends.0 as usize].first as usize..blocks[ends.1 as usize].end();
        });
        self.schedule.join(count);
    }
}
