//! A layer of cells behind a plane wall: the image of the cells at it.

use super::GenerationError;
use crate::SimplexMesh;

/// Vertices this close to the plane, in units of the longest edge, are on it.
const ON_THE_PLANE: f64 = 1e-9;

/// The mesh with the images of the cells that touch the plane x_`axis` = `position`, mirrored at it; `None` where the mesh does not end there:
/// where no facet of its boundary lies in the plane, or there are vertices on both sides.
///
/// The nodes that a particle on the plane has weights on are those joined to the vertices of its facet, so they come in pairs of images with
/// equal weights, and a velocity that is odd about the plane vanishes on it: a wall keeps the order of the basis. Vertices and cells
/// of the mesh keep their numbers. Ours.
///
/// # Errors
/// [`GenerationError::Mesh`] where the images are no valid mesh together with it.
pub fn with_mirrored_layer<const D: usize>(
    mesh: &SimplexMesh<D>,
    axis: usize,
    position: f64,
) -> Result<Option<SimplexMesh<D>>, GenerationError> {
    let limit = ON_THE_PLANE * mesh.edge_lengths().longest;
    let heights: Vec<f64> = mesh
        .vertices()
        .iter()
        .map(|x| x.get(axis).map_or(f64::NAN, |c| c - position))
        .collect();
    let on_plane = |vertex: u32| heights[vertex as usize].abs() <= limit;
    let (above, below) = (
        heights.iter().any(|&height| height > limit),
        heights.iter().any(|&height| height < -limit),
    );
    let ends_there = mesh
        .boundary()
        .iter()
        .any(|facet| facet.vertices.iter().all(|&vertex| on_plane(vertex)));
    if above == below || !ends_there {
        return Ok(None);
    }
    let mut vertices = mesh.vertices().to_vec();
    let mut cells: Vec<u32> = mesh.cells().flatten().copied().collect();
    let mut images = vec![u32::MAX; vertices.len()];
    for cell in mesh.cells().filter(|cell| cell.iter().any(|&vertex| on_plane(vertex))) {
        let first = cells.len();
        for &vertex in cell {
            let image = &mut images[vertex as usize];
            if *image == u32::MAX {
                *image = vertex;
                if !on_plane(vertex) {
                    *image = vertices.len() as u32;
                    let mut x = mesh.vertices()[vertex as usize];
                    x[axis] = 2.0 * position - x[axis];
                    vertices.push(x);
                }
            }
            cells.push(*image);
        }
        cells.swap(first, first + 1); // a reflection turns cells inside out
    }
    Ok(Some(SimplexMesh::new(vertices, cells)?))
}
