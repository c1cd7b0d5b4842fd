//! The vertices that a particle of a cell interacts with.

use crate::SimplexMesh;
use crate::adjacency::{Lists, Union};

/// The first ring of every cell: N¹ = its vertices and all vertices that an edge joins to one of them, in ascending order.
///
/// Equally the vertices of all cells that share a vertex with the cell (Cao et al. 2024, §2.3.2, Fig. 1).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rings {
    lists: Lists,
    largest: usize,
}

impl Rings {
    /// The first rings of a mesh. A ring has 12 vertices in a lattice of equilateral triangles, about 31 in a body-centred one.
    pub fn new<const D: usize>(mesh: &SimplexMesh<D>) -> Self {
        let joined = mesh.vertex_neighbours();
        let mut lists = Lists::default();
        let mut largest = 0;
        let mut union = Union::new(mesh.vertices().len());
        for cell in mesh.cells() {
            let around = cell.iter().flat_map(|&vertex| joined.get(vertex as usize));
            let ring = union.of(cell.iter().chain(around).copied());
            largest = largest.max(ring.len());
            lists.push(ring);
        }
        Self { lists, largest }
    }

    /// The ring of a cell.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    #[inline(always)]
    pub fn ring(&self, cell: usize) -> &[u32] {
        self.lists.get(cell)
    }

    /// The rings by cell.
    pub fn lists(&self) -> &Lists {
        &self.lists
    }

    /// Number of vertices of the largest ring.
    pub fn largest(&self) -> usize {
        self.largest
    }
}
