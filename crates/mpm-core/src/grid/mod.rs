//! Uniform B-spline grid, stored as a hashed set of blocks of 64 nodes: memory follows the active nodes, time does not
//! depend on the number of nodes per axis.

mod block;
mod block_map;
mod template;

use std::marker::PhantomData;

use mpm_kernels::{Entry, Spline, Stencil};

use self::block::{locate, node_at, slot_count};
use self::block_map::BlockMap;
use self::template::Template;
use crate::{Basis, MpmError, Schedule};

/// Grid coordinates beyond ±2³⁰ are refused.
const COORDINATE_LIMIT: f64 = (1u64 << 30) as f64;

/// A block number and a place in the block share 32 bits.
const BLOCK_LIMIT: u32 = 1 << 26;

/// The nodes {origin + h i : i ∈ ℤᴰ} with tensor-product B-splines of kernel `S`; only touched nodes are stored.
#[derive(Clone, Debug)]
pub struct SplineGrid<S, const W: usize, const D: usize> {
    kernel: PhantomData<S>,
    origin: [f64; D],
    spacing: f64,
    template: Template<D>,
    /// Blocks that hold particles (the base of their stencil).
    particle_blocks: BlockMap<D>,
    /// Blocks that hold active nodes.
    node_blocks: BlockMap<D>,
    /// Which of a block's 64 nodes are active.
    masks: Vec<u64>,
    /// Number of the first active node of every block, and their count at the end.
    first_nodes: Vec<u32>,
    /// For every group (particle block in lexicographic order) and slot of the template: number of the node block.
    neighbours: Vec<u32>,
    /// Place in its block, for every cell.
    cell_places: Vec<u8>,
    /// Group, for every cell.
    cell_groups: Vec<u32>,
    schedule: Schedule,
    scratch: Scratch,
}

/// Buffers of the rebuild, kept between steps.
#[derive(Clone, Debug, Default)]
struct Scratch {
    /// (block number << 6) | place, for every particle.
    keys: Vec<u32>,
    /// Blocks in lexicographic order, and each block's rank in it.
    sorted_blocks: Vec<u32>,
    ranks: Vec<u32>,
    /// Next free place per (rank, cell).
    cursors: Vec<u32>,
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// A grid of spacing `h` with a node at `origin`.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless `h` is positive and `h` and `origin` are finite.
    pub fn new(origin: [f64; D], h: f64) -> Result<Self, MpmError> {
        const {
            assert!(
                slot_count::<D>(W) <= 1 << 16,
                "the stencil reaches more blocks than 16 bits can number"
            )
        }
        let mut grid = Self {
            kernel: PhantomData,
            origin,
            spacing: h,
            template: Template::new(W),
            particle_blocks: BlockMap::default(),
            node_blocks: BlockMap::default(),
            masks: Vec::new(),
            first_nodes: Vec::new(),
            neighbours: Vec::new(),
            cell_places: Vec::new(),
            cell_groups: Vec::new(),
            schedule: Schedule::default(),
            scratch: Scratch::default(),
        };
        grid.place(origin, h)?;
        Ok(grid)
    }

    /// Move the grid: a node at `origin`, spacing `h`. Takes effect with the next rebuild.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless `h` is positive and `h` and `origin` are finite.
    pub fn place(&mut self, origin: [f64; D], h: f64) -> Result<(), MpmError> {
        if let Some(&value) = origin.iter().find(|c| !c.is_finite()) {
            return Err(MpmError::InvalidParameter {
                field: "origin",
                value,
                expected: "finite",
            });
        }
        if !(h > 0.0 && h.is_finite()) {
            return Err(MpmError::InvalidParameter {
                field: "spacing",
                value: h,
                expected: "positive and finite",
            });
        }
        (self.origin, self.spacing) = (origin, h);
        Ok(())
    }

    /// The rebuild, in four phases.
    fn renumber(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
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
        let inverse = 1.0 / self.spacing;
        let mut last = ([i32::MAX; D], 0);
        for (particle, x) in positions.iter().enumerate() {
            let u: [f64; D] = std::array::from_fn(|a| (x[a] - self.origin[a]) * inverse);
            if !u.iter().all(|u| u.abs() < COORDINATE_LIMIT) {
                return Err(MpmError::PositionOutOfRange {
                    particle,
                    position: x.to_vec(),
                    spacing: self.spacing,
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

// SAFETY: only `rebuild` changes what the two methods of the contract read; where it fails, no group is left. `colour_groups` lists every group once. Stencils
// with their base in one block touch blocks at offsets 0 ≤ offset < reach per axis (`Template`); two blocks of one colour
// differ by a non-zero multiple of reach on some axis, so that the blocks their stencils touch are disjoint, and so are
// the numbers of the nodes in them.
#[allow(unsafe_code)]
unsafe impl<S: Spline<W>, const W: usize, const D: usize> Basis<D> for SplineGrid<S, W, D> {
    fn rebuild(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let result = self.renumber(positions);
        if result.is_err() {
            self.schedule = Schedule::default(); // half a rebuild must not be scattered to
        }
        result
    }

    fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    fn node_count(&self) -> usize {
        self.first_nodes.last().map_or(0, |&count| count as usize)
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        out.reserve(self.node_count());
        for (block, &mask) in self.node_blocks.coordinates().iter().zip(&self.masks) {
            let mut rest = mask;
            while rest != 0 {
                let node = node_at(block, rest.trailing_zeros());
                out.push(std::array::from_fn(|a| self.origin[a] + self.spacing * node[a] as f64));
                rest &= rest - 1;
            }
        }
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn stencil_size(&self) -> usize {
        Stencil::<W, D>::SIZE
    }

    #[inline]
    fn cell_nodes(&self, cell: usize, nodes: &mut Vec<u32>) {
        let slots = self.template.neighbours.len();
        let row = &self.neighbours[self.cell_groups[cell] as usize * slots..][..slots];
        nodes.clear();
        nodes.extend(
            self.template
                .nodes(u32::from(self.cell_places[cell]))
                .iter()
                .map(|&(slot, place)| {
                    let block = row[slot as usize] as usize;
                    let before = match self.masks[block] {
                        u64::MAX => u32::from(place),
                        mask => (mask & ((1u64 << place) - 1)).count_ones(),
                    };
                    self.first_nodes[block] + before
                }),
        );
    }

    #[inline(always)]
    fn for_each_node(&self, x: &[f64; D], visit: impl FnMut(usize, &Entry<D>)) {
        Stencil::<W, D>::new::<S>(x, &self.origin, self.spacing).for_each(visit);
    }

    #[inline(always)]
    fn for_each_flux(&self, x: &[f64; D], value: &[f64; D], scale: f64, visit: impl FnMut(usize, f64, &[f64; D])) {
        Stencil::<W, D>::new::<S>(x, &self.origin, self.spacing).for_each_flux(value, scale, visit);
    }

    #[inline(always)]
    fn affine_direction(&self, entry: &Entry<D>) -> [f64; D] {
        match S::SECOND_MOMENT {
            None => entry.gradient,
            Some(moment) => {
                let scale = entry.weight / (moment * self.spacing * self.spacing);
                entry.offset.map(|c| c * scale)
            }
        }
    }

    fn storage_bytes(&self) -> usize {
        let s = &self.scratch;
        let words = [
            &self.first_nodes,
            &self.neighbours,
            &self.cell_groups,
            &s.keys,
            &s.sorted_blocks,
            &s.ranks,
            &s.cursors,
        ];
        self.template.storage_bytes()
            + self.particle_blocks.storage_bytes()
            + self.node_blocks.storage_bytes()
            + self.masks.capacity() * 8
            + self.cell_places.capacity()
            + words.iter().map(|v| v.capacity() * 4).sum::<usize>()
            + self.schedule.storage_bytes()
    }
}
