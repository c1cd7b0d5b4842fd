//! Coordinates in which a mesh is of unit size.

use mpm_mesh::{MeshError, SimplexMesh};
use mpm_tensor::vector;
use parvi_targets::Frame;

/// The frame of a round density as wide as the mesh: μ the mesh's centroid, L = r I with r² = ∫ |x − μ|² / (D V), by the midpoint rule; no less than an edge.
pub(super) fn frame_of<const D: usize>(mesh: &SimplexMesh<D>) -> Frame<D> {
    let centre_of = |cell: &[u32]| -> [f64; D] {
        std::array::from_fn(|a| {
            let sum: f64 = cell.iter().map(|&vertex| mesh.vertices()[vertex as usize][a]).sum();
            sum / (D + 1) as f64
        })
    };
    let total = mesh.total_volume();
    let average = |of: &dyn Fn(&[f64; D]) -> f64| {
        let cells = mesh.cells().enumerate();
        cells
            .map(|(k, cell)| mesh.volume(k) / total * of(&centre_of(cell)))
            .sum::<f64>()
    };
    let centre: [f64; D] = std::array::from_fn(|a| average(&|x| x[a]));
    let square = average(&|x| vector::distance_squared(x, &centre)) / D as f64;
    let edge = mesh.edge_lengths().mean;
    let radius = square.sqrt().max(edge);
    Frame::from_scales(centre, [radius; D]).unwrap_or_else(|_| Frame::identity())
}

/// The mesh in coordinates of the frame.
pub(super) fn in_frame<const D: usize>(mesh: &SimplexMesh<D>, frame: &Frame<D>) -> Result<SimplexMesh<D>, MeshError> {
    let vertices = mesh.vertices().iter().map(|x| frame.to_reference(x)).collect();
    SimplexMesh::new(vertices, mesh.cells().flatten().copied().collect())
}
