//! The rebuild, phase 1: the block and the cell of every particle, as runs of particles that follow each other in one cell.

use mpm_kernels::Spline;
use rayon::prelude::*;

use super::SplineGrid;
use super::block::locate;
use crate::MpmError;

/// Particles of one piece of work. The runs do not depend on it: those that it cuts are joined again.
const CHUNK: usize = 1 << 13;

/// A block number and a place in the block share 32 bits.
const BLOCK_LIMIT: u32 = 1 << 26;

/// The runs in a stretch of particles.
#[derive(Clone, Debug)]
pub(super) struct ChunkRuns<const D: usize> {
    /// Blocks as they are met; one may be met several times.
    blocks: Vec<[i32; D]>,
    /// First particle of a run, and (index in `blocks` << 6) | place.
    runs: Vec<(u32, u32)>,
    /// Whether all particles are where they may be.
    sound: bool,
}

impl<const D: usize> ChunkRuns<D> {
    pub fn storage_bytes(&self) -> usize {
        self.blocks.capacity() * size_of::<[i32; D]>() + self.runs.capacity() * 8
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Find the runs: their first particles become the schedule's cells, their (block, place) the cells' keys, blocks being
    /// numbered as they are met.
    pub(super) fn locate_particles(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let mut chunks = std::mem::take(&mut self.scratch.chunks);
        let count = positions.len().div_ceil(CHUNK);
        if chunks.len() < count {
            chunks.resize_with(count, || ChunkRuns {
                blocks: Vec::new(),
                runs: Vec::new(),
                sound: true,
            });
        }
        let work = chunks.par_iter_mut().zip(positions.par_chunks(CHUNK)).enumerate();
        work.for_each(|(index, (chunk, xs))| self.find_runs(index * CHUNK, xs, chunk));
        let result = if chunks[..count].iter().all(|chunk| chunk.sound) {
            self.join_runs(&chunks[..count], positions.len())
        } else {
            Err(self.misplaced(positions))
        };
        self.scratch.chunks = chunks;
        result
    }

    /// The runs of the particles from `first` on.
    fn find_runs(&self, first: usize, positions: &[[f64; D]], chunk: &mut ChunkRuns<D>) {
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

    /// Put the chunks' runs together, and number the blocks.
    fn join_runs(&mut self, chunks: &[ChunkRuns<D>], particles: usize) -> Result<(), MpmError> {
        self.particle_blocks.clear();
        self.cell_keys.clear();
        let starts = &mut self.schedule.cell_starts;
        starts.clear();
        for chunk in chunks {
            let (mut met, mut number) = (u32::MAX, 0);
            for &(start, key) in &chunk.runs {
                if key >> 6 != met {
                    met = key >> 6;
                    number = self.particle_blocks.number(chunk.blocks[met as usize]);
                    if number >= BLOCK_LIMIT {
                        let nodes = u64::from(number); // every block of particles has a node of its own: a stencil's base
                        return Err(MpmError::TooManyNodes { nodes });
                    }
                }
                let key = (number << 6) | (key & 63);
                if self.cell_keys.last() != Some(&key) {
                    self.cell_keys.push(key);
                    starts.push(start);
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
