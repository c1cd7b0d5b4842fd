//! The rebuild, phases 3 and 4: active nodes and parts.

use mpm_kernels::Spline;

use super::SplineGrid;
use super::locate::place_bits;
use super::lookup::NodeBlock;
use super::tile::{has_tiles, members, words};
use crate::{Basis, MpmError, Part};

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
            for place in members(&self.occupied[rank * words::<D>(W)..][..words::<D>(W)]) {
                if const { has_tiles::<D>() } {
                    let (slot, local) = self.template.tile[place];
                    touched[usize::from(slot)] |= 1 << local;
                    continue;
                }
                for &(slot, mask) in self.template.touched(place as u32) {
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
        Ok(())
    }

    /// Phase 4 (activate): cut the cells into parts.
    pub(super) fn divide_cells(&mut self) {
        let slots = self.template.neighbours.len();
        let (neighbours, blocks, cell_keys) = (&self.neighbours, &self.blocks, &self.cell_keys);
        let (size, count) = (self.stencil_size(), self.node_count());
        self.schedule.cut(size);
        mpm_parallel::each(self.schedule.parts.iter_mut(), &|part: &mut Part| {
            let (mut last, mut ends) = (u32::MAX, (u32::MAX, 0));
            for key in &cell_keys[part.cells.clone()] {
                if key >> place_bits::<D>() == last {
                    continue;
                }
                last = key >> place_bits::<D>();
                let touched = neighbours[last as usize * slots..][..slots].iter();
                let touched = touched.filter(|&&block| block != u32::MAX);
                ends = touched.fold(ends, |(low, high), &block| (low.min(block), high.max(block)));
            }
            part.nodes = blocks[ends.0 as usize].first as usize..blocks[ends.1 as usize].end();
        });
        self.schedule.join(count);
    }
}
