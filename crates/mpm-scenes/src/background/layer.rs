//! The cells around a mesh.

use std::collections::BTreeMap;

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{GenerationError, with_mirrored_layer, with_outer_layer};
use mpm_tensor::vector::{accumulate, dot, norm, scale, subtract};

use super::{named_facets, smooth_parts};
use crate::scene::{FacetCondition, Scene};
use crate::shape::Bounds;
use crate::{SceneFault, plane};

/// The mesh with the images of its cells behind the walls and the plane groups of facets that it ends at, and with other cells around the rest of its boundary.
///
/// Behind walls and facets nodes are tied to their images, for which walls need some; facets do with images between nodes, or without, where mirrored cells would spoil the mesh.
pub(super) fn around<const D: usize>(
    scene: &Scene,
    inner: &SimplexMesh<D>,
    room: &Bounds<D>,
    groups: &BTreeMap<String, Vec<u32>>,
) -> Result<SimplexMesh<D>, SceneFault> {
    let mut planes = Vec::new();
    for (index, wall) in scene.walls.iter().enumerate() {
        planes.push(plane::build(room, index, wall)?);
    }
    let plain = completed(inner, &planes)
        .map_err(|error| SceneFault::value("mesh.outer_layer", true, format!("false for this mesh: {error}")))?;
    let held = scene.facets.iter();
    let held = held.filter(|table| table.condition != FacetCondition::Traction);
    let parts = held.filter_map(|table| {
        let facets = groups.get(&table.group)?;
        let slides = matches!(table.condition, FacetCondition::Slip | FacetCondition::Friction);
        Some(if slides {
            smooth_parts(inner, facets)
        } else {
            vec![facets.clone()]
        })
    });
    let held: Vec<_> = parts.flatten().filter_map(|part| plane_of(inner, &part)).collect();
    Ok(if held.is_empty() {
        plain
    } else {
        mirrored(inner, plain, planes, held)
    })
}

/// A completed mesh, or one with images behind held planes, too: behind all of them, or behind those that do not spoil the mesh.
fn mirrored<const D: usize>(
    inner: &SimplexMesh<D>,
    plain: SimplexMesh<D>,
    mut planes: Vec<Plane<D>>,
    held: Vec<Plane<D>>,
) -> SimplexMesh<D> {
    let shortest = |mesh: &SimplexMesh<D>| mesh.edge_lengths().shortest;
    let least = LEAST_EDGE * shortest(&plain);
    let sound = |planes: &[_]| completed(inner, planes).ok().filter(|mesh| shortest(mesh) > least);
    if let Some(whole) = sound(&[planes.as_slice(), &held].concat()) {
        return whole;
    }
    let mut whole = plain;
    for plane in held {
        planes.push(plane);
        match sound(&planes) {
            Some(mesh) => whole = mesh,
            None => drop(planes.pop()),
        }
    }
    whole
}

/// A point, and the unit normal into the mesh.
type Plane<const D: usize> = ([f64; D], [f64; D]);

/// Where a plane group goes over into the rest of the boundary at an angle near 180°, images leave a narrow notch: cells there may shorten the edges, and with them the step, by this factor.
const LEAST_EDGE: f64 = 0.7;

/// The mesh with the images of its cells behind these planes, and with other cells around the rest of its boundary.
fn completed<const D: usize>(inner: &SimplexMesh<D>, planes: &[Plane<D>]) -> Result<SimplexMesh<D>, GenerationError> {
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

/// The plane that all of some facets of the boundary lie in, if they do.
fn plane_of<const D: usize>(inner: &SimplexMesh<D>, facets: &[u32]) -> Option<Plane<D>> {
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

#[cfg(test)]
mod tests {
    use mpm_mesh::generate::{EdgeTarget, outlines};

    use super::*;

    /// A hull whose plane bottom goes over into its sides at 170°, where images would leave notches of 20°; at its top there are none.
    #[test]
    fn a_plane_that_spoils_the_mesh_takes_no_images_from_another() {
        let right = [[1.0, 0.0], [1.985, 0.174], [1.985, 1.0]];
        let left = right.iter().rev().map(|[x, y]| [1.0 - x, *y]);
        let hull = right.into_iter().chain(left).collect();
        let target = EdgeTarget {
            length: 0.2,
            angle: 0.2,
        };
        let inner = outlines(&[hull], &target).expect("a mesh");
        let plain = completed(&inner, &[]).expect("a layer");
        let (bottom, top) = (([0.0, 0.0], [0.0, 1.0]), ([0.0, 1.0], [0.0, -1.0]));
        let expected = mirrored(&inner, plain.clone(), Vec::new(), vec![top]);
        assert!(expected.vertices().len() != plain.vertices().len());
        for held in [vec![top, bottom], vec![bottom, top]] {
            let found = mirrored(&inner, plain.clone(), Vec::new(), held);
            assert!(found.vertices() == expected.vertices());
        }
        let nothing = mirrored(&inner, plain.clone(), Vec::new(), vec![bottom]);
        assert!(nothing.vertices() == plain.vertices());
    }
}
