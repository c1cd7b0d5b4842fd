//! A layer of cells behind a plane wall: the image of the cells at it.

use mpm_tensor::vector::{add_scaled, dot, subtract};

use super::GenerationError;
use crate::SimplexMesh;

/// Vertices this close to the plane, in units of the longest edge, are on it.
const ON_THE_PLANE: f64 = 1e-9;

/// The mesh with the images of the cells that touch the plane through `point` with the unit vector `normal`, mirrored at it; `None` where the mesh does not end there:
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
    point: &[f64; D],
    normal: &[f64; D],
) -> Result<Option<SimplexMesh<D>>, GenerationError> {
    let limit = ON_THE_PLANE * mesh.edge_lengths().longest;
    let heights: Vec<f64> = mesh
        .vertices()
        .iter()
        .map(|x| dot(normal, &subtract(x, point)))
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
                    let (x, height) = (&mesh.vertices()[vertex as usize], heights[vertex as usize]);
                    vertices.push(add_scaled(x, -2.0 * height, normal));
                }
            }
            cells.push(*image);
        }
        cells.swap(first, first + 1); // a reflection turns cells inside out
    }
    Ok(Some(SimplexMesh::new(vertices, cells)?))
}
