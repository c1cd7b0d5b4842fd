//! The rebuild, phases 1 and 2: the cell of every particle, and the order of the particles.

use mpm_core::MpmError;
use rayon::prelude::*;

use super::{MeshBasis, Outside};
use crate::NO_CELL;

/// Particles of one piece of work.
const CHUNK: usize = 1 << 12;

impl<const D: usize> MeshBasis<D> {
    /// Phase 1 (sort): the cell of every particle, looked for from the cell that the particle in its place was in before.
    ///
    /// The cells do not depend on where the search begins, so a run that is resumed finds the same.
    pub(super) fn locate_particles(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let (search, outside) = (&self.search, self.outside);
        let cell_of = |x: &[f64; D], before: u32| match (search.locate(x, Some(before)), outside) {
            (Some(located), _) => located.cell,
            (None, Outside::Refuse) => NO_CELL,
            (None, Outside::Extrapolate { reach }) => {
                search.nearest(x, reach).map_or(NO_CELL, |near| near.located.cell)
            }
        };
        self.particle_cells.resize(positions.len(), NO_CELL);
        let chunks = self
            .particle_cells
            .par_chunks_mut(CHUNK)
            .zip(positions.par_chunks(CHUNK));
        chunks.for_each(|(cells, positions)| {
            let mut near = NO_CELL;
            for (cell, x) in cells.iter_mut().zip(positions) {
                near = cell_of(x, if *cell == NO_CELL { near } else { *cell });
                *cell = near;
            }
        });
        all_found(&self.particle_cells, positions)
    }

    /// Phase 2 (sort): order the particles by cell, where they are far from it; their cells follow them.
    pub(super) fn sort_particles(&mut self) {
        let cell_count = self.mesh().cell_count();
        self.cell_sort
            .sort_with_cells(&mut self.particle_cells, cell_count, &mut self.schedule);
    }
}

/// The first of the particles that no cell was found for is an error.
pub(crate) fn all_found<const D: usize>(cells: &[u32], positions: &[[f64; D]]) -> Result<(), MpmError> {
    match cells.iter().position(|&cell| cell == NO_CELL) {
        None => Ok(()),
        Some(particle) => Err(MpmError::OutsideMesh {
            particle,
            position: positions[particle].to_vec(),
        }),
    }
}
