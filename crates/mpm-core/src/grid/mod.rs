//! Uniform B-spline grid, stored as a hashed set of blocks of 64 nodes: memory follows the active nodes, time does not
//! depend on the number of nodes per axis.

mod block;
mod rebuild;
mod template;

use std::marker::PhantomData;

use mpm_kernels::{Deposit, Entry, Spline, Stencil, UniformGrid};

use self::block::{node_at, slot_count};
use self::template::Template;
use crate::basis::check_placement;
use crate::key_map::KeyMap;
use crate::{Basis, MpmError, Schedule, UniformBasis};

/// The nodes {origin + h i : i ∈ ℤᴰ} with tensor-product B-splines of kernel `S`; only touched nodes are stored.
#[derive(Clone, Debug)]
pub struct SplineGrid<S, const W: usize, const D: usize> {
    kernel: PhantomData<S>,
    nodes: UniformGrid<D>,
    template: Template<D>,
    /// Blocks that hold particles (the base of their stencil).
    particle_blocks: KeyMap<[i32; D]>,
    /// Blocks that hold active nodes.
    node_blocks: KeyMap<[i32; D]>,
    /// Which of a block's 64 nodes are active.
    masks: Vec<u64>,
    /// Number of the first active node of every block, and their count at the end.
    first_nodes: Vec<u32>,
    /// For every particle block, in lexicographic order, and slot of the template: number of the node block.
    neighbours: Vec<u32>,
    /// For every particle block, in lexicographic order: numbers of its first cell, and of cells at the end.
    block_cells: Vec<u32>,
    /// Place in its block, for every cell.
    cell_places: Vec<u8>,
    /// Rank of its block, for every cell.
    cell_blocks: Vec<u32>,
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
    /// First particle per (rank, place).
    bin_starts: Vec<u32>,
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
            nodes: UniformGrid::new(origin, h),
            template: Template::new(W),
            particle_blocks: KeyMap::default(),
            node_blocks: KeyMap::default(),
            masks: Vec::new(),
            first_nodes: Vec::new(),
            neighbours: Vec::new(),
            block_cells: Vec::new(),
            cell_places: Vec::new(),
            cell_blocks: Vec::new(),
            schedule: Schedule::default(),
            scratch: Scratch::default(),
        };
        grid.place(origin, h)?;
        Ok(grid)
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> UniformBasis<D> for SplineGrid<S, W, D> {
    fn place(&mut self, origin: [f64; D], h: f64) -> Result<(), MpmError> {
        check_placement(&origin, h)?;
        self.nodes = UniformGrid::new(origin, h);
        Ok(())
    }

    fn cell_point(&self, fraction: &[f64; D], h: f64) -> [f64; D] {
        fraction.map(|c| c * h)
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> Basis<D> for SplineGrid<S, W, D> {
    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.schedule.clear();
        self.locate_particles(positions)?;
        self.sort_particles();
        Ok(())
    }

    fn activate(&mut self, _: &[[f64; D]]) -> Result<(), MpmError> {
        self.activate_nodes()?;
        self.divide_cells();
        Ok(())
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
        for (block, &mask) in self.node_blocks.keys().iter().zip(&self.masks) {
            let mut rest = mask;
            while rest != 0 {
                let node = node_at(block, rest.trailing_zeros());
                out.push(self.nodes.node_position(&node));
                rest &= rest - 1;
            }
        }
    }

    fn spacing(&self) -> f64 {
        self.nodes.spacing()
    }

    fn stencil_size(&self) -> usize {
        Stencil::<W, D>::SIZE
    }

    #[inline]
    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        let slots = self.template.neighbours.len();
        let row = &self.neighbours[self.cell_blocks[cell] as usize * slots..][..slots];
        scratch.clear();
        scratch.extend(
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
        scratch
    }

    #[inline(always)]
    fn for_each_node(&self, _: usize, x: &[f64; D], visit: impl FnMut(usize, &Entry<D>)) {
        Stencil::<W, D>::new::<S>(x, &self.nodes).for_each(visit);
    }

    #[inline(always)]
    fn for_each_deposit(
        &self,
        _: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        scale: f64,
        visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        Stencil::<W, D>::new::<S>(x, &self.nodes).for_each_deposit(value, scale, visit);
    }

    #[inline(always)]
    fn affine_direction(&self, entry: &Entry<D>) -> [f64; D] {
        match S::SECOND_MOMENT {
            None => entry.gradient,
            Some(moment) => {
                let scale = entry.weight / (moment * self.nodes.spacing() * self.nodes.spacing());
                entry.offset.map(|c| c * scale)
            }
        }
    }

    fn storage_bytes(&self) -> usize {
        let s = &self.scratch;
        let words = [
            &self.first_nodes,
            &self.neighbours,
            &self.block_cells,
            &self.cell_blocks,
            &s.keys,
            &s.sorted_blocks,
            &s.ranks,
            &s.bin_starts,
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
