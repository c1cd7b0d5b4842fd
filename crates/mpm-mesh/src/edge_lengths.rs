//! How long the edges of a mesh are.

use mpm_tensor::vector::distance;

use crate::SimplexMesh;

/// The lengths of the edges, each edge counted once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeLengths {
    /// The shortest.
    pub shortest: f64,
    /// The mean.
    pub mean: f64,
    /// The longest, h_max: what UMLS-MPM takes as the size of the mesh.
    pub longest: f64,
}

impl<const D: usize> SimplexMesh<D> {
    /// Shortest, mean and longest edge.
    pub fn edge_lengths(&self) -> EdgeLengths {
        let edges = self.edges();
        let position = |vertex: u32| &self.vertices()[vertex as usize];
        let lengths = edges.iter().map(|&[a, b]| distance(position(a), position(b)));
        let (mut shortest, mut longest, mut sum) = (f64::INFINITY, 0f64, 0.0);
        for length in lengths {
            shortest = shortest.min(length);
            longest = longest.max(length);
            sum += length;
        }
        EdgeLengths {
            shortest,
            mean: sum / edges.len() as f64,
            longest,
        }
    }
}
