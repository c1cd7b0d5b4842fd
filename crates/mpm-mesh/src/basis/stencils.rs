//! What particles of a cell have in common: its first ring, and which vertices of the cell each node of it is joined to.

use crate::{Rings, SimplexMesh};

/// The rings of all cells.
#[derive(Clone, Debug)]
pub(super) struct Stencils {
    rings: Rings,
    /// For every node of every ring the set of the cell's vertices that it is joined to or is: vertex n is bit n. The adjacency matrix A, A_ii = 1.
    joined: Vec<u8>,
}

impl Stencils {
    pub fn new<const D: usize>(mesh: &SimplexMesh<D>) -> Self {
        let rings = Rings::new(mesh);
        let neighbours = mesh.vertex_neighbours();
        let mut joined = Vec::with_capacity(rings.lists().items().len());
        for (cell, ring) in mesh.cells().zip(rings.lists().iter()) {
            for node in ring {
                let is_joined =
                    |vertex: &u32| vertex == node || neighbours.get(*vertex as usize).binary_search(node).is_ok();
                let bit = |(n, vertex)| u8::from(is_joined(vertex)) << n;
                joined.push(cell.iter().enumerate().map(bit).sum());
            }
        }
        Self { rings, joined }
    }

    /// The nodes of a cell, in ascending order.
    #[inline(always)]
    pub fn ring(&self, cell: u32) -> &[u32] {
        self.rings.ring(cell as usize)
    }

    /// For every node of a cell which vertices of the cell it is joined to.
    #[inline(always)]
    pub fn joined(&self, cell: u32) -> &[u8] {
        let lists = self.rings.lists();
        &self.joined[lists.start(cell as usize)..lists.start(cell as usize + 1)]
    }

    /// Nodes of the largest ring.
    pub fn largest(&self) -> usize {
        self.rings.largest()
    }

    pub fn storage_bytes(&self) -> usize {
        self.joined.len() * 5 + self.rings.lists().len() * size_of::<usize>()
    }
}
