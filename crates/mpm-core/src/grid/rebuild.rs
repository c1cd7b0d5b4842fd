//! The rebuild: from positions to cells, active nodes and colours.

use mpm_kernels::Spline;

use super::block::locate;
use super::{Scratch, SplineGrid};
use crate::{MpmError, Schedule};

/// Grid coordinates beyond ±2³⁰ are refused.
const COORDINATE_LIMIT: f64 = (1u64 << 30) as f64;

/// A block number and a place in the block share 32 bits.
const BLOCK_LIMIT: u32 = 1 << 26;

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// The rebuild, in four phases.
    pub(super) fn renumber(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.locate_particles(positions)?;
        self.sort_particles();
        self.activate_nodes()?;
        self.colour_groups();
        Ok(())
    }

    /// Phase 1 of the rebuild: the block and the cell of every particle.
    fn locate_particles(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
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

    /// Phase 2: counting sort of the particles by (block in lexicographic order, cell).
    fn sort_particles(&mut self) {
        let Scratch {
            keys,
            sorted_blocks,
            ranks,
            cursors,
        } = &mut self.scratch;
        let blocks = self.particle_blocks.coordinates();
        sorted_blocks.clear();
        sorted_blocks.extend(0..blocks.len() as u32);
        sorted_blocks.sort_unstable_by_key(|&number| blocks[number as usize]);
        ranks.clear();
        ranks.resize(blocks.len(), 0);
        for (rank, &number) in sorted_blocks.iter().enumerate() {
            ranks[number as usize] = rank as u32;
        }
        cursors.clear();
        cursors.resize(blocks.len() * 64, 0);
        for key in keys.iter_mut() {
            *key = (ranks[(*key >> 6) as usize] << 6) | (*key & 63);
            cursors[*key as usize] += 1;
        }

        let Schedule {
            order,
            cell_starts,
            group_starts,
            ..
        } = &mut self.schedule;
        cell_starts.clear();
        group_starts.clear();
        self.cell_places.clear();
        self.cell_groups.clear();
        let mut start = 0;
        for (slot, cursor) in cursors.iter_mut().enumerate() {
            if slot % 64 == 0 {
                group_starts.push(cell_starts.len() as u32);
            }
            let count = *cursor;
            *cursor = start;
            if count > 0 {
                cell_starts.push(start);
                self.cell_places.push((slot % 64) as u8);
                self.cell_groups.push((slot / 64) as u32);
                start += count;
            }
        }
        group_starts.push(cell_starts.len() as u32);
        cell_starts.push(start);
        order.clear();
        order.resize(keys.len(), 0);
        for (particle, &key) in keys.iter().enumerate() {
            let cursor = &mut cursors[key as usize];
            order[*cursor as usize] = particle as u32;
            *cursor += 1;
        }
    }

    /// Phase 3: activate and number the nodes that the occupied cells touch.
    fn activate_nodes(&mut self) -> Result<(), MpmError> {
        self.node_blocks.clear();
        self.masks.clear();
        let slots = self.template.neighbours.len();
        self.neighbours.clear();
        self.neighbours.resize(self.schedule.group_count() * slots, u32::MAX);
        let mut touched = vec![0u64; slots];
        for (group, &number) in self.scratch.sorted_blocks.iter().enumerate() {
            touched.fill(0);
            for cell in self.schedule.group(group) {
                for &(slot, mask) in self.template.touched(u32::from(self.cell_places[cell])) {
                    touched[slot as usize] |= mask;
                }
            }
            let home = self.particle_blocks.coordinates()[number as usize];
            let row = &mut self.neighbours[group * slots..][..slots];
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

    /// Phase 4: sort the groups by colour.
    fn colour_groups(&mut self) {
        let colours = self.template.neighbours.len();
        let blocks = self.particle_blocks.coordinates();
        let colour = |number: &u32| self.template.colour(&blocks[*number as usize]);
        let Schedule {
            coloured_groups,
            colour_starts,
            ..
        } = &mut self.schedule;
        colour_starts.clear();
        colour_starts.resize(colours + 1, 0);
        let sorted = &self.scratch.sorted_blocks;
        for number in sorted {
            colour_starts[colour(number) + 1] += 1;
        }
        for c in 0..colours {
            colour_starts[c + 1] += colour_starts[c];
        }
        let mut cursors = colour_starts.clone();
        coloured_groups.clear();
        coloured_groups.resize(sorted.len(), 0);
        for (group, number) in sorted.iter().enumerate() {
            let cursor = &mut cursors[colour(number)];
            coloured_groups[*cursor as usize] = group as u32;
            *cursor += 1;
        }
    }
}
