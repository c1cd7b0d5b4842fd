//! A layer of cells outside the boundary of a mesh.

mod extrude;
mod strip;

use super::GenerationError;
use crate::SimplexMesh;

/// Which part of a mesh is the layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OuterLayer {
    /// Vertices from this number on belong to the layer alone; before, there are those of the mesh inside.
    pub first_vertex: usize,
    /// Cells from this number on are the layer; before, there are those of the mesh inside.
    pub first_cell: usize,
}

/// The mesh with a layer of cells around it, so that every vertex of its boundary lies inside the new mesh.
///
/// At a boundary cell the first ring is one-sided, and moving least squares give negative weights. Cao et al. (2024) add
/// cells beyond the boundary by hand; here it is done for any mesh. How is ours:
///
/// * D = 1: a segment at either end of each interval, 0.8 as long as the one beside it.
/// * D = 2: outside every boundary edge the third point of an equilateral triangle, at convex corners as many more on an
///   arc as make angles of about 60°, none nearer than half an edge to the boundary or another; constrained Delaunay
///   triangulation of boundary and points; of its triangles those outside that have a vertex on the boundary. So narrow bays and holes are
///   filled.
/// * D = 3: every boundary triangle becomes a prism, of 0.8 times the boundary's edges in height, and three tetrahedra. Its height is reduced
///   where a prism would fold at a re-entrant corner, and everywhere as long as new cells meet.
///
/// # Errors
/// [`GenerationError::NoLayer`], where no positive height is enough; [`GenerationError::Mesh`] where parts of the boundary
/// are so close that cells meet at any height.
pub fn with_outer_layer<const D: usize>(
    mesh: &SimplexMesh<D>,
) -> Result<(SimplexMesh<D>, OuterLayer), GenerationError> {
    let layer = OuterLayer {
        first_vertex: mesh.vertices().len(),
        first_cell: mesh.cell_count(),
    };
    let whole = match D {
        2 => strip::surrounded(mesh)?,
        _ => extrude::surrounded(mesh)?,
    };
    let marks = whole.on_boundary();
    match marks[..layer.first_vertex].iter().position(|&marked| marked) {
        Some(vertex) => Err(GenerationError::NoLayer { vertex }),
        None => Ok((whole, layer)),
    }
}

/// The mesh with further vertices and cells behind its own.
fn joined<const D: usize>(
    mesh: &SimplexMesh<D>,
    vertices: &[[f64; D]],
    cells: &[u32],
) -> Result<SimplexMesh<D>, GenerationError> {
    let own: Vec<u32> = mesh.cells().flatten().copied().collect();
    Ok(SimplexMesh::new(
        [mesh.vertices(), vertices].concat(),
        [&own, cells].concat(),
    )?)
}
