//! Vertices and the simplices between them.

use crate::MeshError;

/// A mesh of segments (D = 1), triangles (2) or tetrahedra (3).
#[derive(Debug, Clone, PartialEq)]
pub struct SimplexMesh<const D: usize> {
    vertices: Vec<[f64; D]>,
    /// D + 1 vertex numbers per cell.
    cells: Vec<u32>,
}

impl<const D: usize> SimplexMesh<D> {
    /// From the positions of the vertices and D + 1 vertex numbers per cell, one cell after the other.
    ///
    /// # Errors
    /// [`MeshError`], which names the element.
    pub fn new(vertices: Vec<[f64; D]>, cells: Vec<u32>) -> Result<Self, MeshError> {
        let empty = |what| Err(MeshError::Empty { what });
        if vertices.is_empty() {
            return empty("vertices");
        }
        if cells.is_empty() {
            return empty("cells");
        }
        if !cells.len().is_multiple_of(D + 1) {
            return Err(MeshError::RaggedCells {
                count: cells.len(),
                per_cell: D + 1,
            });
        }
        if let Some(place) = cells.iter().position(|&v| v as usize >= vertices.len()) {
            return Err(MeshError::UnknownVertex {
                cell: place / (D + 1),
                vertex: cells[place],
                vertex_count: vertices.len(),
            });
        }
        Ok(Self { vertices, cells })
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
    pub fn cell(&self, cell: usize) -> &[u32] {
        &self.cells[cell * (D + 1)..(cell + 1) * (D + 1)]
    }

    /// The cells, one after the other.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.cells.chunks_exact(D + 1)
    }
}
