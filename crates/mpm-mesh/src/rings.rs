//! The vertices that a particle of a cell interacts with.

use crate::SimplexMesh;
use crate::adjacency::Lists;

/// The first ring of every cell: N¹ = its vertices and all vertices that an edge joins to one of them, in ascending order.
///
/// Equally the vertices of all cells that share a vertex with the cell (Cao et al. 2024, §3.1).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rings {
    lists: Lists,
    largest: usize,
}

impl Rings {
    /// The first rings of a mesh. A ring has about 13 vertices in two dimensions, 50 in three.
    pub fn new<const D: usize>(mesh: &SimplexMesh<D>) -> Self {
        let joined = mesh.vertex_neighbours();
        let mut lists = Lists::default();
        let (mut largest, mut ring) = (0, Vec::new());
        for cell in mesh.cells() {
            ring.clear();
            ring.extend_from_slice(cell);
            cell.iter()
                .for_each(|&v| ring.extend_from_slice(joined.get(v as usize)));
            ring.sort_unstable();
            ring.dedup();
            largest = largest.max(ring.len());
            lists.push(&ring);
        }
        Self { lists, largest }
    }

    /// The ring of a cell.
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
