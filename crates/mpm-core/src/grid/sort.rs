//! The rebuild, phase 2: particles stay in their order as long as it is nearly that of the cells.

use mpm_kernels::Spline;

use super::locate::place_bits;
use super::tile::{RIM, has_tiles, words};
use super::{Scratch, SplineGrid};
use crate::counting_sort::counting_sort;
use crate::{MpmError, Schedule};

/// Particles are sorted once one in so many is followed by one of an earlier cell, or begins one tile too many. Sorting moves all fields of
/// all particles; not sorting makes more and shorter cells, whose nodes are collected one by one.
const fn particles_per_disorder<const D: usize>() -> usize {
    if has_tiles::<D>() { 128 } else { 8 }
}

/// Write down the numbers of the blocks in lexicographic order. No method of the grid: a sort is much code, and this one is compiled once for all kernels.
fn in_order<const D: usize>(blocks: &[[i32; D]], sorted: &mut Vec<u32>) {
    sorted.clear();
    sorted.extend(0..blocks.len() as u32);
    sorted.sort_unstable_by_key(|&number| blocks[number as usize]);
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Find the cells, and sort the particles by them unless they nearly are.
    ///
    /// What is done depends on the positions in their present order alone: a run that is resumed sorts when the run that was not
    /// interrupted does, and so do any number of threads.
    pub(super) fn sort_or_keep(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.locate_particles(positions, RIM)?;
        let disorder = self.rank_blocks();
        if disorder * particles_per_disorder::<D>() <= positions.len() {
            self.keep_order();
            return Ok(());
        }
        if const { has_tiles::<D>() } {
            self.locate_particles(positions, 0)?;
            self.rank_blocks();
        }
        self.sort_particles();
        Ok(())
    }

    /// Bring the blocks into lexicographic order; returns how many cells follow a later one, or how many tiles there are more than blocks.
    pub(super) fn rank_blocks(&mut self) -> usize {
        let (bits, words) = (place_bits::<D>(), words::<D>(W));
        let blocks = self.particle_blocks.keys();
        in_order(blocks, &mut self.sorted_blocks);
        let ranks = &mut self.scratch.ranks;
        ranks.clear();
        ranks.resize(blocks.len(), 0);
        for (rank, &number) in self.sorted_blocks.iter().enumerate() {
            ranks[number as usize] = rank as u32;
        }
        self.occupied.clear();
        self.occupied.resize(blocks.len() * words, 0);
        let (mut last, mut descents) = (0, 0);
        for (cell, key) in self.cell_keys.iter_mut().enumerate() {
            let rank = ranks[(*key >> bits) as usize];
            *key = (rank << bits) | (*key & ((1 << bits) - 1));
            if const { has_tiles::<D>() } {
                let touched = &self.touched[cell * words..][..words];
                for (all, more) in self.occupied[rank as usize * words..].iter_mut().zip(touched) {
                    *all |= more;
                }
            } else {
                self.occupied[rank as usize] |= 1 << (*key & 63);
            }
            descents += usize::from(*key < last);
            last = *key;
        }
        if const { has_tiles::<D>() } {
            return self.cell_keys.len() - blocks.len();
        }
        descents
    }

    /// All particles stay where they are; the runs are the cells.
    fn keep_order(&mut self) {
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

    /// Counting sort of the particles by (block in lexicographic order, cell), or by tile.
    fn sort_particles(&mut self) {
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
        let bins = self.sorted_blocks.len() << place_bits::<D>();
        counting_sort(keys, bins, bin_starts, order, cursors);
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
