//! Hat functions on a mesh.

use mpm_core::{Basis, CellSort, MpmError, Schedule};
use mpm_kernels::Entry;
use mpm_tensor::vector::subtract;
use rayon::prelude::*;

use crate::basis::all_found;
use crate::{CellSearch, NO_CELL, SimplexMesh};

/// Particles of one piece of work.
const CHUNK: usize = 1 << 12;

/// The piecewise linear functions with w_i(x_j) = δ_ij: in a cell the barycentric coordinates λ of its vertices, D + 1 per particle.
///
/// ∇w_i = ∇λ is the gradient of w_i, constant in every cell, so that Stein's identity E\[w_i s + ∇w_i\] = 0 holds for every w_i that vanishes on the
/// boundary. (The diffuse gradient of [`MeshBasis`](crate::MeshBasis) has no such identity.) Nodes are the vertices of the mesh, all of them, by their
/// own numbers. A particle outside the mesh is an error, [`MpmError::OutsideMesh`].
///
/// A node of which particles are far has next to no mass, and ∇w_i all the same: bodies of solid want shorter steps than on splines.
#[derive(Clone, Debug)]
pub struct HatBasis<const D: usize> {
    search: CellSearch<D>,
    spacing: f64,
    /// Cells of the particles in schedule order.
    particle_cells: Vec<u32>,
    schedule: Schedule,
    cell_sort: CellSort,
}

impl<const D: usize> HatBasis<D> {
    /// Hat functions on a copy of `mesh`, whose cells and vertices keep their numbers.
    pub fn new(mesh: &SimplexMesh<D>) -> Self {
        Self {
            spacing: mesh.edge_lengths().mean,
            search: CellSearch::new(mesh.clone()),
            particle_cells: Vec::new(),
            schedule: Schedule::default(),
            cell_sort: CellSort::default(),
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &SimplexMesh<D> {
        self.search.mesh()
    }

    /// Move every position that is outside of the mesh to the nearest point of it. The positions are those that the basis was last sorted with, in
    /// schedule order, after a short move; what is not a number stays.
    pub fn pull_inside(&self, positions: &mut [[f64; D]]) {
        let near = self.particle_cells.par_chunks(CHUNK);
        positions.par_chunks_mut(CHUNK).zip(near).for_each(|(positions, near)| {
            for (x, &cell) in positions.iter_mut().zip(near) {
                if self.search.locate(x, Some(cell)).is_some() {
                    continue;
                }
                let mut reaches = [self.spacing, 8.0 * self.spacing, f64::INFINITY].into_iter();
                if let Some(nearest) = reaches.find_map(|reach| self.search.nearest(x, reach)) {
                    *x = nearest.position;
                }
            }
        });
    }

    fn locate_particles(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let search = &self.search;
        self.particle_cells.resize(positions.len(), NO_CELL);
        let chunks = self.particle_cells.par_chunks_mut(CHUNK);
        chunks.zip(positions.par_chunks(CHUNK)).for_each(|(cells, positions)| {
            for (cell, x) in cells.iter_mut().zip(positions) {
                *cell = search.locate(x, Some(*cell)).map_or(NO_CELL, |located| located.cell);
            }
        });
        all_found(&self.particle_cells, positions)
    }

    fn cell_of(&self, cell: usize) -> &[u32] {
        let particle = self.schedule.cell(cell).start;
        self.mesh().cell(self.particle_cells[particle] as usize)
    }
}

impl<const D: usize> Basis<D> for HatBasis<D> {
    type Cell = ();

    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        if let Err(error) = self.locate_particles(positions) {
            self.schedule = Schedule::default();
            return Err(error);
        }
        let cell_count = self.mesh().cell_count();
        self.cell_sort
            .sort_with_cells(&mut self.particle_cells, cell_count, &mut self.schedule);
        Ok(())
    }

    fn activate(&mut self, _: &[[f64; D]]) -> Result<(), MpmError> {
        self.schedule.cut(D + 1);
        let starts: Vec<usize> = (0..self.schedule.cell_count())
            .map(|cell| self.schedule.cell(cell).start)
            .collect();
        let (mesh, cells) = (self.search.mesh(), &self.particle_cells);
        for part in self.schedule.parts_mut() {
            let particles = starts[part.cells.clone()].iter();
            let nodes = particles.flat_map(|&particle| mesh.cell(cells[particle] as usize));
            let (low, high) = nodes.fold((u32::MAX, 0), |(low, high), &node| (low.min(node), high.max(node)));
            part.nodes = low as usize..high as usize + 1;
        }
        self.schedule.join(self.node_count());
        Ok(())
    }

    fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    fn node_count(&self) -> usize {
        self.mesh().vertices().len()
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        out.extend(self.mesh().vertices());
    }

    /// The mean length of the edges.
    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn stencil_size(&self) -> usize {
        D + 1
    }

    #[inline(always)]
    fn cell_nodes<'a>(&'a self, cell: usize, _: &'a mut Vec<u32>) -> &'a [u32] {
        self.cell_of(cell)
    }

    #[inline(always)]
    fn for_each_node(&self, particle: usize, x: &[f64; D], mut visit: impl FnMut(usize, &Entry<D>)) {
        let cell = self.particle_cells[particle];
        let frame = self.search.frame(cell);
        let coordinates = frame.coordinates(x);
        let vertices = self.mesh().vertices();
        let nodes = self.mesh().cell(cell as usize);
        for k in 0..=D {
            let weight = if k > 0 {
                coordinates[k - 1]
            } else {
                1.0 - coordinates.iter().sum::<f64>()
            };
            let entry = Entry {
                weight,
                gradient: frame.gradient(k),
                offset: subtract(&vertices[nodes[k] as usize], x),
            };
            visit(k, &entry);
        }
    }

    /// Hats are piecewise linear: ∇w_ip (docs/theory.md, Eq. 23).
    #[inline(always)]
    fn affine_direction(&self, _: usize, _: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        entry.gradient
    }

    /// The mesh itself is not counted.
    fn storage_bytes(&self) -> usize {
        self.search.storage_bytes()
            + self.schedule.storage_bytes()
            + self.cell_sort.storage_bytes()
            + self.particle_cells.capacity() * 4
    }
}
