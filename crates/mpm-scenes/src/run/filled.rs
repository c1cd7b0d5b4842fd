//! Where bodies are at the facets of a mesh.

use std::collections::BTreeSet;

use mpm_mesh::{BoundaryFacet, CellSearch, Lists, SimplexMesh};

use crate::population::Population;

/// What bodies fill of the cells of a mesh.
pub(super) struct Filled<'a, const D: usize> {
    mesh: &'a SimplexMesh<D>,
    vertex_cells: Lists,
    /// Volume of the particles in each cell.
    volumes: Vec<f64>,
}

impl<'a, const D: usize> Filled<'a, D> {
    /// With these particles.
    pub fn new(mesh: &'a SimplexMesh<D>, population: &Population<D>) -> Self {
        let search = CellSearch::new(mesh.clone());
        let (mut volumes, mut near) = (vec![0.0; mesh.cell_count()], None);
        let sizes = population.volumes.iter().zip(&population.stretches);
        for (x, (volume, stretch)) in population.positions.iter().zip(sizes) {
            near = search.locate(x, near).map(|place| place.cell);
            if let Some(cell) = near {
                volumes[cell as usize] += volume * stretch.powi(D as i32);
            }
        }
        Self {
            mesh,
            vertex_cells: mesh.vertex_cells(),
            volumes,
        }
    }

    /// Whether a body is at a facet: it fills more than half of the cells that have a vertex of it.
    pub fn is_touched(&self, facet: &BoundaryFacet<D>) -> bool {
        let at_vertices = facet
            .vertices
            .iter()
            .flat_map(|&vertex| self.vertex_cells.get(vertex as usize));
        let cells: BTreeSet<usize> = at_vertices.map(|&cell| cell as usize).collect();
        let sum = |volume: &dyn Fn(usize) -> f64| cells.iter().map(|&cell| volume(cell)).sum::<f64>();
        sum(&|cell| self.volumes[cell]) > 0.5 * sum(&|cell| self.mesh.volume(cell))
    }
}
