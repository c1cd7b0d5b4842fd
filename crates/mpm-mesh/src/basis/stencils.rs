//! What particles of a cell have in common: its first ring, and which vertices of the cell each node of it is joined to.

use mpm_kernels::{LANES, Lanes};

use crate::adjacency::Lists;
use crate::{Rings, SimplexMesh};

/// The rings of all cells in groups of four nodes: the last node of a ring is repeated to the end of its group.
#[derive(Clone, Debug)]
pub(super) struct Stencils {
    rings: Lists,
    /// For every node of every ring the set of the cell's vertices that it is joined to or is: vertex n is bit n; nothing for what is repeated. The adjacency
    /// matrix A, A_ii = 1.
    joined: Vec<u8>,
    /// Vertices that an edge joins to each.
    neighbours: Lists,
    /// Vertices, zeros behind their coordinates.
    vertices: Vec<Lanes>,
    largest: usize,
}

impl Stencils {
    pub fn new<const D: usize>(mesh: &SimplexMesh<D>) -> Self {
        let rings = Rings::new(mesh);
        let neighbours = mesh.vertex_neighbours();
        let (mut padded, mut joined, mut largest) = (Lists::default(), Vec::new(), 0);
        let mut nodes = Vec::new();
        for (cell, ring) in mesh.cells().zip(rings.lists().iter()) {
            let length = ring.len().next_multiple_of(LANES);
            largest = largest.max(length);
            nodes.clear();
            nodes.extend_from_slice(ring);
            nodes.resize(length, ring[ring.len() - 1]);
            padded.push(&nodes);
            for node in ring {
                let is_joined =
                    |vertex: &u32| vertex == node || neighbours.get(*vertex as usize).binary_search(node).is_ok();
                let bit = |(n, vertex)| u8::from(is_joined(vertex)) << n;
                joined.push(cell.iter().enumerate().map(bit).sum());
            }
            joined.resize(padded.items().len(), 0);
        }
        let lanes = |x: &[f64; D]| Lanes::new(std::array::from_fn(|a| x.get(a).copied().unwrap_or(0.0)));
        Self {
            rings: padded,
            joined,
            neighbours,
            vertices: mesh.vertices().iter().map(lanes).collect(),
            largest,
        }
    }

    /// The nodes of a cell, in ascending order, in whole groups.
    #[inline(always)]
    pub fn groups(&self, cell: u32) -> &[u32] {
        self.rings.get(cell as usize)
    }

    /// The nodes of a cell, in ascending order, each once.
    #[inline(always)]
    pub fn ring(&self, cell: u32) -> &[u32] {
        let repeated = self.joined(cell).iter().rev().take_while(|&&set| set == 0);
        let groups = self.groups(cell);
        &groups[..groups.len() - repeated.count()]
    }

    /// For every node of [`groups`](Self::groups) which vertices of the cell it is joined to.
    #[inline(always)]
    pub fn joined(&self, cell: u32) -> &[u8] {
        &self.joined[self.rings.start(cell as usize)..self.rings.start(cell as usize + 1)]
    }

    /// The vertices that an edge joins to a vertex.
    #[inline(always)]
    pub fn joined_to(&self, vertex: usize) -> &[u32] {
        self.neighbours.get(vertex)
    }

    /// Position of a vertex, zeros behind the coordinates.
    #[inline(always)]
    pub fn position(&self, vertex: u32) -> Lanes {
        self.vertices[vertex as usize]
    }

    /// Positions of all vertices, zeros behind the coordinates.
    pub fn vertices(&self) -> &[Lanes] {
        &self.vertices
    }

    /// Places of the largest ring.
    pub fn largest(&self) -> usize {
        self.largest
    }

    pub fn storage_bytes(&self) -> usize {
        let items = self.joined.len() * 5 + self.neighbours.items().len() * 4;
        let starts = (self.rings.len() + self.neighbours.len()) * size_of::<usize>();
        items + starts + self.vertices.len() * size_of::<Lanes>()
    }
}
