//! The cells around a mesh.

use std::collections::BTreeMap;

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{GenerationError, with_mirrored_layer, with_outer_layer};
use mpm_tensor::vector::{accumulate, dot, norm, scale, subtract};

use super::named_facets;
use crate::scene::{FacetCondition, Scene, WallCondition};
use crate::shape::Bounds;
use crate::{SceneFault, plane};

/// The mesh with the images of its cells behind the walls and the plane groups of facets that it ends at, and with other cells around the rest of its boundary.
///
/// Behind what nothing leaves (fixed, prescribed, sliding) nodes are tied to their images, for which walls need some; facets do with images between nodes where mirrored cells would spoil the mesh.
pub(super) fn around<const D: usize>(
    scene: &Scene,
    inner: &SimplexMesh<D>,
    room: &Bounds<D>,
    groups: &BTreeMap<String, Vec<u32>>,
) -> Result<SimplexMesh<D>, SceneFault> {
    let mut planes = Vec::new();
    let walls = scene.walls.iter().enumerate();
    for (index, wall) in walls.filter(|(_, wall)| wall.condition != WallCondition::Friction) {
        planes.push(plane::build(room, index, wall)?);
    }
    let plain = completed(inner, &planes)
        .map_err(|error| SceneFault::value("mesh.outer_layer", true, format!("false for this mesh: {error}")))?;
    let holds = |condition| !matches!(condition, FacetCondition::Friction | FacetCondition::Traction);
    let held = scene.facets.iter().filter(|table| holds(table.condition));
    let before = planes.len();
    planes.extend(held.filter_map(|table| plane_of(inner, groups.get(&table.group)?)));
    if planes.len() == before {
        return Ok(plain);
    }
    let shortest = |mesh: &SimplexMesh<D>| mesh.edge_lengths().shortest;
    let mirrored = completed(inner, &planes).ok();
    Ok(mirrored
        .filter(|mirrored| shortest(mirrored) > LEAST_EDGE * shortest(&plain))
        .unwrap_or(plain))
}

/// Where a plane group goes over into the rest of the boundary at an angle near 180°, images leave a narrow notch: cells there may shorten the edges, and with them the step, by this factor.
const LEAST_EDGE: f64 = 0.7;

/// The mesh with the images of its cells behind these planes, and with other cells around the rest of its boundary.
fn completed<const D: usize>(
    inner: &SimplexMesh<D>,
    planes: &[([f64; D], [f64; D])],
) -> Result<SimplexMesh<D>, GenerationError> {
    let mut whole = inner.clone();
    for (point, normal) in planes {
        if let Some(mirrored) = with_mirrored_layer(&whole, point, normal)? {
            whole = mirrored;
        }
    }
    let own = whole.on_boundary().into_iter().take(inner.vertices().len());
    if own.into_iter().any(|marked| marked) {
        whole = with_outer_layer(&whole)?.0;
    }
    Ok(whole)
}

/// Facets whose normals differ by less, and whose vertices are nearer to a plane in units of the longest edge, are in it.
const IN_THE_PLANE: f64 = 1e-9;

/// The plane that all of some facets of the boundary lie in, if they do: a point, and the unit normal into the mesh.
fn plane_of<const D: usize>(inner: &SimplexMesh<D>, facets: &[u32]) -> Option<([f64; D], [f64; D])> {
    let (mut sum, mut area) = ([0.0; D], 0.0);
    for facet in named_facets(inner, facets) {
        accumulate(&mut sum, -facet.area, &facet.normal);
        area += facet.area;
    }
    let length = norm(&sum);
    let normal = scale(&sum, 1.0 / length);
    let position = |vertex: u32| inner.vertices()[vertex as usize];
    let point = position(*facets.first()?);
    let limit = IN_THE_PLANE * inner.edge_lengths().longest;
    let in_plane = |&vertex: &u32| dot(&normal, &subtract(&position(vertex), &point)).abs() <= limit;
    (length > (1.0 - IN_THE_PLANE) * area && facets.iter().all(in_plane)).then_some((point, normal))
}
