//! Facets with a cell on one side only.

use mpm_tensor::vector::{norm, scale};

use crate::{NO_CELL, SimplexMesh};

/// A facet of the boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryFacet<const D: usize> {
    /// The cell it belongs to.
    pub cell: u32,
    /// Place in the cell of the vertex opposite.
    pub opposite: usize,
    /// Its vertices, in the order in which they come with [`normal`](Self::normal) on the outside: anticlockwise about it in
    /// three dimensions, with the mesh to the left in two.
    pub vertices: [u32; D],
    /// Outward unit normal.
    pub normal: [f64; D],
    /// (D − 1)-dimensional measure: 1, length, area.
    pub area: f64,
}

impl<const D: usize> SimplexMesh<D> {
    /// The facets of the boundary, by cell and opposite vertex.
    ///
    /// With the cell's volume V and the gradient g = ∇λ_k of the vertex opposite, the normal is −g / |g| and the area D V |g|
    /// (the height above the facet is 1 / |g|).
    pub fn boundary(&self) -> Vec<BoundaryFacet<D>> {
        let places = (0..self.cell_count()).flat_map(|cell| (0..=D).map(move |opposite| (cell, opposite)));
        places
            .filter(|&(cell, opposite)| self.neighbours(cell)[opposite] == NO_CELL)
            .map(|(cell, opposite)| self.boundary_facet(cell, opposite))
            .collect()
    }

    fn boundary_facet(&self, cell: usize, opposite: usize) -> BoundaryFacet<D> {
        let gradient = self.frame(cell).gradient(opposite);
        let length = norm(&gradient);
        BoundaryFacet {
            cell: cell as u32,
            opposite,
            vertices: outward_facet(self.cell(cell), opposite),
            normal: scale(&gradient, -1.0 / length),
            area: D as f64 * self.volume(cell) * length,
        }
    }

    /// For each vertex whether it lies on the boundary.
    pub fn on_boundary(&self) -> Vec<bool> {
        let mut marks = vec![false; self.vertices().len()];
        for cell in 0..self.cell_count() {
            for (opposite, &neighbour) in self.neighbours(cell).iter().enumerate() {
                if neighbour == NO_CELL {
                    let others = self.cell(cell).iter().enumerate().filter(|&(k, _)| k != opposite);
                    others.for_each(|(_, &vertex)| marks[vertex as usize] = true);
                }
            }
        }
        marks
    }
}

/// The vertices other than number `opposite` of a positively oriented cell, ordered as seen from outside.
pub(crate) fn outward_facet<const D: usize>(cell: &[u32], opposite: usize) -> [u32; D] {
    let mut vertices: [u32; D] = std::array::from_fn(|k| cell[if k < opposite { k } else { k + 1 }]);
    // Leaving out vertex k alternates the orientation; without vertex 0 it is (1, …, D), as seen from outside.
    if D > 1 && !opposite.is_multiple_of(2) {
        vertices.swap(0, 1);
    }
    vertices
}
