//! The rebuild, phase 1: the cell of every particle, as runs of particles that follow each other in one cell, or in one tile.

use mpm_kernels::{Lanes, Layout, Spline};
use mpm_parallel::each;

use super::SplineGrid;
use super::block::locate;
use super::tile::{self, Tile, has_tiles, words};
use crate::MpmError;

/// Particles of one piece of work. Runs that it cuts are joined again where they are in the same cell.
const CHUNK: usize = 1 << 13;

/// A block number and a place in the block share 32 bits.
const BLOCK_LIMIT: u32 = 1 << 26;

/// Particles that have a say in which tile they are worked off in.
const LOOK_AHEAD: usize = 8;

/// Bits of the place in the block in the key of a cell.
pub(super) const fn place_bits<const D: usize>() -> u32 {
    if has_tiles::<D>() { 0 } else { 6 }
}

/// The runs in a stretch of particles.
#[derive(Clone, Debug)]
pub(super) struct ChunkRuns<const D: usize> {
    /// Blocks as they are met; one may be met several times.
    blocks: Vec<[i32; D]>,
    /// First particle of a run, and its key with the index in `blocks` in the place of a rank.
    runs: Vec<(u32, u32)>,
    /// The places that the particles of a tile touch.
    touched: Vec<u64>,
    /// Whether all particles are where they may be.
    sound: bool,
}

impl<const D: usize> ChunkRuns<D> {
    pub fn storage_bytes(&self) -> usize {
        self.blocks.capacity() * size_of::<[i32; D]>() + self.runs.capacity() * 8 + self.touched.capacity() * 8
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Find the runs: their first particles become the schedule's cells, their (block, place) the cells' keys, blocks being
    /// numbered as they are met. In a tile particles may be up to `rim` ≤ [`RIM`](tile::RIM) cells outside its block.
    pub(super) fn locate_particles(&mut self, positions: &[[f64; D]], rim: i32) -> Result<(), MpmError> {
        let mut chunks = std::mem::take(&mut self.scratch.chunks);
        let count = positions.len().div_ceil(CHUNK);
        if chunks.len() < count {
            chunks.resize_with(count, || ChunkRuns {
                blocks: Vec::new(),
                runs: Vec::new(),
                touched: Vec::new(),
                sound: true,
            });
        }
        let work = chunks.iter_mut().zip(positions.chunks(CHUNK)).enumerate();
        if const { has_tiles::<D>() } {
            let mut places = std::mem::take(&mut self.places);
            places.resize(positions.len(), 0);
            each(work.zip(places.chunks_mut(CHUNK)), &|((index, (chunk, xs)), places)| {
                self.find_tiles(index * CHUNK, xs, rim, chunk, places);
            });
            self.places = places;
        } else {
            each(work, &|(index, (chunk, xs))| self.find_cells(index * CHUNK, xs, chunk));
        }
        let result = if chunks[..count].iter().all(|chunk| chunk.sound) {
            self.join_runs(&chunks[..count], positions.len())
        } else {
            Err(self.misplaced(positions))
        };
        self.scratch.chunks = chunks;
        result
    }

    /// The runs of the particles from `first` on, by cell.
    fn find_cells(&self, first: usize, positions: &[[f64; D]], chunk: &mut ChunkRuns<D>) {
        chunk.blocks.clear();
        chunk.runs.clear();
        chunk.sound = true;
        let (mut last_block, mut last_place) = ([i32::MAX; D], u32::MAX);
        for (k, x) in positions.iter().enumerate() {
            let node = self.nodes.first_node::<S, W>(x);
            chunk.sound &= node.is_some() && self.admits(x);
            let (block, place) = locate(&node.unwrap_or([0; D]));
            if block == last_block && place == last_place {
                continue;
            }
            if block != last_block {
                chunk.blocks.push(block);
            }
            (last_block, last_place) = (block, place);
            let index = chunk.blocks.len() as u32 - 1;
            chunk.runs.push(((first + k) as u32, (index << 6) | place));
        }
    }

    /// The runs of the particles from `first` on, by tile, and the particles' places in them. A run ends with the first particle that its tile does not hold.
    fn find_tiles(&self, first: usize, positions: &[[f64; D]], rim: i32, chunk: &mut ChunkRuns<D>, places: &mut [u16]) {
        chunk.blocks.clear();
        chunk.runs.clear();
        chunk.touched.clear();
        chunk.sound = true;
        let layout = const { Layout::<D>::in_box(W, &tile::edges::<D>(W)) };
        let (mut tile, mut set) = (Tile::NONE, 0);
        for (k, (x, to)) in positions.iter().zip(places).enumerate() {
            let node = self.nodes.first_nodes::<S, W>(x);
            chunk.sound &= self.admits(x);
            if !tile.holds(node) {
                let Some(block) = self.common_block(&positions[k..positions.len().min(k + LOOK_AHEAD)], rim) else {
                    chunk.sound = false; // out of range
                    continue;
                };
                tile = Tile::new(&block, rim);
                set = chunk.touched.len();
                chunk.touched.resize(set + words::<D>(W), 0);
                chunk.runs.push(((first + k) as u32, chunk.blocks.len() as u32));
                chunk.blocks.push(block);
            }
            let place = tile.place(node, &layout);
            *to = place as u16;
            chunk.touched[set + place / 64] |= 1 << (place % 64);
        }
        for places in chunk.touched.chunks_exact_mut(words::<D>(W)) {
            tile::dilate::<D>(places, W);
        }
    }

    /// Of the blocks of these particles, that whose tile holds the most of them in a row from the first on; `None` where the first is out of range.
    fn common_block(&self, positions: &[[f64; D]], rim: i32) -> Option<[i32; D]> {
        let block = |x: &[f64; D]| Some(locate(&self.nodes.first_node::<S, W>(x)?).0);
        let mut best = block(&positions[0])?;
        if rim == 0 {
            return Some(best);
        }
        let mut nodes = [Lanes::ZERO; LOOK_AHEAD];
        for (node, x) in nodes.iter_mut().zip(positions) {
            *node = self.nodes.first_nodes::<S, W>(x);
        }
        let nodes = &nodes[..positions.len()];
        let mut most = 0;
        for block in positions.iter().map_while(block) {
            let tile = Tile::new(&block, rim);
            let held = nodes.iter().take_while(|&&node| tile.holds(node)).count();
            if held > most {
                (best, most) = (block, held);
            }
        }
        Some(best)
    }

    /// Put the chunks' runs together, and number the blocks.
    fn join_runs(&mut self, chunks: &[ChunkRuns<D>], particles: usize) -> Result<(), MpmError> {
        let (bits, words) = (place_bits::<D>(), words::<D>(W));
        self.particle_blocks.clear();
        self.cell_keys.clear();
        self.touched.clear();
        let starts = &mut self.schedule.cell_starts;
        starts.clear();
        for chunk in chunks {
            let (mut met, mut number) = (u32::MAX, 0);
            for (run, &(start, key)) in chunk.runs.iter().enumerate() {
                if key >> bits != met {
                    met = key >> bits;
                    number = self.particle_blocks.number(chunk.blocks[met as usize]);
                    if number >= BLOCK_LIMIT {
                        let nodes = u64::from(number); // every block of particles has a node of its own: a stencil's base
                        return Err(MpmError::TooManyNodes { nodes });
                    }
                }
                let key = (number << bits) | (key & ((1 << bits) - 1));
                let goes_on = self.cell_keys.last() == Some(&key);
                if !goes_on {
                    self.cell_keys.push(key);
                    starts.push(start);
                }
                if const { has_tiles::<D>() } {
                    let touched = &chunk.touched[run * words..][..words];
                    if goes_on {
                        let last = self.touched.len() - words;
                        for (all, more) in self.touched[last..].iter_mut().zip(touched) {
                            *all |= more;
                        }
                    } else {
                        self.touched.extend_from_slice(touched);
                    }
                }
            }
        }
        starts.push(particles as u32);
        Ok(())
    }

    /// Whether a particle may be at `x`, as far as the limits are concerned.
    #[inline(always)]
    fn admits(&self, x: &[f64; D]) -> bool {
        let inside = |(lower, upper): &([f64; D], [f64; D])| (0..D).all(|a| x[a] >= lower[a] && x[a] <= upper[a]);
        self.limits.as_ref().is_none_or(inside)
    }

    /// The first particle outside the limits, else the first one out of range.
    #[cold]
    fn misplaced(&self, positions: &[[f64; D]]) -> MpmError {
        let outside = positions.iter().position(|x| !self.admits(x));
        if let (Some(particle), Some((lower, upper))) = (outside, self.limits) {
            return MpmError::OutsideDomain {
                particle,
                position: positions[particle].to_vec(),
                lower: lower.to_vec(),
                upper: upper.to_vec(),
            };
        }
        let far = |x: &[f64; D]| self.nodes.first_node::<S, W>(x).is_none();
        let particle = positions.iter().position(far).unwrap_or(0);
        MpmError::PositionOutOfRange {
            particle,
            position: positions[particle].to_vec(),
            spacing: self.nodes.spacing(),
        }
    }
}
