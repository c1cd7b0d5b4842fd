//! The rebuild, phase 2: particles stay in their order as long as it is nearly that of the cells.

use mpm_kernels::Spline;

use super::{Scratch, SplineGrid};
use crate::Schedule;
use crate::counting_sort::counting_sort;

/// Particles are sorted once one in so many is followed by one of an earlier cell. Sorting moves all fields of all particles;
/// not sorting makes more and shorter cells, whose nodes are collected one by one.
const PARTICLES_PER_DESCENT: usize = 8;

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Bring the blocks into lexicographic order, and tell whether the particles are nearly in that of the cells.
    ///
    /// The answer depends on the positions in their present order alone: a run that is resumed sorts when the run that was not
    /// interrupted does, and so do any number of threads.
    pub(super) fn is_nearly_sorted(&mut self) -> bool {
        let blocks = self.particle_blocks.keys();
        self.sorted_blocks.clear();
        self.sorted_blocks.extend(0..blocks.len() as u32);
        self.sorted_blocks
            .sort_unstable_by_key(|&number| blocks[number as usize]);
        let ranks = &mut self.scratch.ranks;
        ranks.clear();
        ranks.resize(blocks.len(), 0);
        for (rank, &number) in self.sorted_blocks.iter().enumerate() {
            ranks[number as usize] = rank as u32;
        }
        self.occupied.clear();
        self.occupied.resize(blocks.len(), 0);
        let (mut last, mut descents) = (0, 0);
        for key in &mut self.cell_keys {
            *key = (ranks[(*key >> 6) as usize] << 6) | (*key & 63);
            self.occupied[(*key >> 6) as usize] |= 1 << (*key & 63);
            descents += usize::from(*key < last);
            last = *key;
        }
        let particles = self.schedule.cell_starts.last().map_or(0, |&count| count as usize);
        descents * PARTICLES_PER_DESCENT <= particles
    }

    /// All particles stay where they are; the runs are the cells.
    pub(super) fn keep_order(&mut self) {
        let Schedule {
            order,
            cell_starts,
            keeps_order,
            ..
        } = &mut self.schedule;
        let particles = cell_starts.last().copied().unwrap_or(0);
        if !*keeps_order || order.len() != particles as usize {
            order.clear();
            order.extend(0..particles);
            *keeps_order = true;
        }
    }

    /// Counting sort of the particles by (block in lexicographic order, cell).
    pub(super) fn sort_particles(&mut self) {
        let Scratch {
            keys,
            bin_starts,
            cursors,
            ..
        } = &mut self.scratch;
        let Schedule { order, cell_starts, .. } = &mut self.schedule;
        keys.clear();
        for (run, &key) in cell_starts.windows(2).zip(&self.cell_keys) {
            keys.resize(run[1] as usize, key);
        }
        counting_sort(keys, self.occupied.len() * 64, bin_starts, order, cursors);
        cell_starts.clear();
        self.cell_keys.clear();
        for (bin, range) in bin_starts.windows(2).enumerate() {
            if range[0] < range[1] {
                cell_starts.push(range[0]);
                self.cell_keys.push(bin as u32);
            }
        }
        cell_starts.push(order.len() as u32);
        self.schedule.keeps_order = false;
    }
}
