//! Vertices and the simplices between them.

mod bins;
mod conformity;
mod facets;
mod frame;
mod validity;

pub use self::facets::NO_CELL;
pub use self::frame::Frame;
pub(crate) use self::frame::signed_volume;

use crate::MeshError;

/// A mesh of segments (D = 1), triangles (2) or tetrahedra (3), valid from its construction on.
///
/// A valid mesh has finite vertices, each in some cell and no two at one place; positively oriented cells,
/// det(x₁ − x₀, …, x_D − x₀) > 0; and is conforming: two cells that share a facet lie on its two sides, no third cell shares
/// it, and no vertex lies in a cell that it does not belong to.
///
/// What is not looked for: two parts of a mesh that cross without a vertex of one in a cell of the other.
#[derive(Debug, Clone, PartialEq)]
pub struct SimplexMesh<const D: usize> {
    vertices: Vec<[f64; D]>,
    /// D + 1 vertex numbers per cell.
    cells: Vec<u32>,
    /// D + 1 cell numbers per cell, the k-th across the facet opposite its k-th vertex.
    neighbours: Vec<u32>,
}

impl<const D: usize> SimplexMesh<D> {
    /// From the positions of the vertices and D + 1 vertex numbers per cell, one cell after the other.
    ///
    /// Takes time and memory in proportion to the mesh, and as long as a sort of the facets.
    ///
    /// # Errors
    /// [`MeshError`], which names the element; of several defects the first found.
    pub fn new(vertices: Vec<[f64; D]>, cells: Vec<u32>) -> Result<Self, MeshError> {
        validity::check(&vertices, &cells)?;
        let neighbours = facets::neighbours::<D>(&cells)?;
        let mesh = Self {
            vertices,
            cells,
            neighbours,
        };
        conformity::check(&mesh)?;
        Ok(mesh)
    }

    /// As [`new`](Self::new), without the vertices that no cell names; the others keep their order.
    ///
    /// # Errors
    /// [`MeshError`], numbers of vertices as they are after the others are dropped.
    pub fn from_used(vertices: &[[f64; D]], cells: &[u32]) -> Result<Self, MeshError> {
        let mut numbers = vec![u32::MAX; vertices.len()];
        for (place, &vertex) in cells.iter().enumerate() {
            let number = numbers.get_mut(vertex as usize);
            *number.ok_or(MeshError::UnknownVertex {
                cell: place / (D + 1),
                vertex,
                vertex_count: vertices.len(),
            })? = 0;
        }
        let mut kept = Vec::new();
        for (number, position) in numbers.iter_mut().zip(vertices) {
            if *number == 0 {
                *number = kept.len() as u32;
                kept.push(*position);
            }
        }
        Self::new(kept, cells.iter().map(|&v| numbers[v as usize]).collect())
    }

    /// Positions of the vertices.
    pub fn vertices(&self) -> &[[f64; D]] {
        &self.vertices
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.len() / (D + 1)
    }

    /// The D + 1 vertices of a cell.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn cell(&self, cell: usize) -> &[u32] {
        &self.cells[cell * (D + 1)..(cell + 1) * (D + 1)]
    }

    /// The cells, one after the other.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[u32]> + Clone {
        self.cells.chunks_exact(D + 1)
    }

    /// D + 1 cells, the k-th across the facet opposite the k-th vertex of `cell`; [`NO_CELL`] at the boundary.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn neighbours(&self, cell: usize) -> &[u32] {
        &self.neighbours[cell * (D + 1)..(cell + 1) * (D + 1)]
    }

    /// Volume of a cell (length, area), det(x₁ − x₀, …, x_D − x₀) / D!; positive.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn volume(&self, cell: usize) -> f64 {
        signed_volume(&self.vertices, self.cell(cell))
    }

    /// The barycentric coordinates of a cell and their gradients.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn frame(&self, cell: usize) -> Frame<D> {
        Frame::new(&self.vertices, self.cell(cell))
    }

    /// Volume of the mesh.
    pub fn total_volume(&self) -> f64 {
        (0..self.cell_count()).map(|cell| self.volume(cell)).sum()
    }
}
