//! No vertex lies in a cell that it does not belong to.

use mpm_tensor::vector::distance;

use super::SimplexMesh;
use super::bins::Bins;
use crate::MeshError;

/// A barycentric coordinate of this size counts as zero. Ours: above the rounding of coordinates that were written with
/// twelve digits or more, and far below any cell of use.
const TOUCHING: f64 = 1e-9;

/// Looks up the vertices in the bounding box of every cell.
pub fn check<const D: usize>(mesh: &SimplexMesh<D>) -> Result<(), MeshError> {
    let bins = Bins::new(mesh.vertices());
    for cell in 0..mesh.cell_count() {
        let members = mesh.cell(cell);
        let bound = |choose: fn(f64, f64) -> f64| -> [f64; D] {
            let position = |&v: &u32| mesh.vertices[v as usize];
            let widen = |a: [f64; D], b: [f64; D]| std::array::from_fn(|axis| choose(a[axis], b[axis]));
            members[1..].iter().map(position).fold(position(&members[0]), widen)
        };
        let frame = mesh.frame(cell);
        let mut found = None;
        bins.for_each_near(&bound(f64::min), &bound(f64::max), |vertex| {
            if found.is_none() && !members.contains(&vertex) {
                let least = frame.least_coordinate(&mesh.vertices[vertex as usize]);
                found = (least >= -TOUCHING).then_some((vertex, least));
            }
        });
        if let Some((vertex, least)) = found {
            return Err(defect(mesh, cell, vertex, least));
        }
    }
    Ok(())
}

fn defect<const D: usize>(mesh: &SimplexMesh<D>, cell: usize, vertex: u32, least: f64) -> MeshError {
    let position = |v: u32| &mesh.vertices[v as usize];
    let longest = (mesh.cell(cell).iter()).map(|&other| distance(position(other), position(mesh.cell(cell)[0])));
    let limit = TOUCHING * longest.fold(0f64, f64::max);
    let near = |&&other: &&u32| distance(position(other), position(vertex)) <= limit;
    let (number, vertex) = (vertex, vertex as usize);
    match mesh.cell(cell).iter().find(near) {
        Some(&other) => MeshError::DuplicateVertices {
            first: number.min(other) as usize,
            second: number.max(other) as usize,
        },
        None if least <= TOUCHING => MeshError::HangingVertex { vertex, cell },
        None => MeshError::VertexInsideCell { vertex, cell },
    }
}
