//! The cells around a mesh.

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{GenerationError, with_mirrored_layer, with_outer_layer};

use crate::scene::{Scene, WallCondition};
use crate::shape::Bounds;
use crate::{SceneFault, plane};

/// The mesh with the images of its cells behind the walls that it ends at, and with other cells around the rest of its boundary.
///
/// Behind a wall that nothing leaves (fixed, prescribed, sliding) nodes are tied to their images, for which there have to be some.
pub(super) fn around<const D: usize>(
    scene: &Scene,
    inner: &SimplexMesh<D>,
    room: &Bounds<D>,
) -> Result<SimplexMesh<D>, SceneFault> {
    let refused =
        |error: GenerationError| SceneFault::value("mesh.outer_layer", true, format!("false for this mesh: {error}"));
    let mut whole = inner.clone();
    let walls = scene.walls.iter().enumerate();
    for (index, wall) in walls.filter(|(_, wall)| wall.condition != WallCondition::Friction) {
        let (point, normal) = plane::build(room, index, wall)?;
        if let Some(mirrored) = with_mirrored_layer(&whole, &point, &normal).map_err(refused)? {
            whole = mirrored;
        }
    }
    let own = whole.on_boundary().into_iter().take(inner.vertices().len());
    if own.into_iter().any(|marked| marked) {
        whole = with_outer_layer(&whole).map_err(refused)?.0;
    }
    Ok(whole)
}
