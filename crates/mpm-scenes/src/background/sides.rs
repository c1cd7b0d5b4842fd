//! The groups of a mesh that is made here.

use std::collections::BTreeMap;

use mpm_mesh::SimplexMesh;

use crate::scene::MeshShapeTable;
use crate::shape::{Bounds, Polygon, Shape};

/// Vertices this near to a plane, in lengths of edges, are in it.
const IN_THE_PLANE: f64 = 1e-9;

/// The names of the sides.
const SIDES: [[&str; 2]; 3] = [["x-lower", "x-upper"], ["y-lower", "y-upper"], ["z-lower", "z-upper"]];

/// The facets of a mesh before it is turned, by group: `inner` and `outer` of a ring; of other shapes with straight sides `x-lower`, `x-upper`, … for those in the planes that bound it, and `hole-1`, … for those of the holes of a polygon.
pub(super) fn sides<const D: usize>(shape: &MeshShapeTable, mesh: &SimplexMesh<D>) -> BTreeMap<String, Vec<u32>> {
    let bounds = Bounds::around(mesh.vertices());
    let mut groups: BTreeMap<String, Vec<u32>> = BTreeMap::new();
    for facet in mesh.boundary() {
        let corners = facet.vertices.map(|vertex| mesh.vertices()[vertex as usize]);
        let name = match shape {
            MeshShapeTable::Ring {
                centre, inner, outer, ..
            } => {
                let square: f64 = corners[0].iter().zip(centre).map(|(x, c)| (x - c).powi(2)).sum();
                let inside = square.sqrt() < 0.5 * (inner + outer);
                Some(if inside { "inner" } else { "outer" }.to_owned())
            }
            MeshShapeTable::Disk { .. } | MeshShapeTable::Ball { .. } | MeshShapeTable::Channel { .. } => None,
            MeshShapeTable::Polygon { holes, .. } => {
                side(&bounds, &corners, shape.size()).or_else(|| hole(holes, &corners, shape.size()))
            }
            _ => side(&bounds, &corners, shape.size()),
        };
        if let Some(name) = name {
            groups.entry(name).or_default().extend(facet.vertices);
        }
    }
    groups
}

/// The side of a box that a facet lies in.
fn side<const D: usize>(bounds: &Bounds<D>, corners: &[[f64; D]; D], size: f64) -> Option<String> {
    let within = |axis: usize, plane: f64| corners.iter().all(|x| (x[axis] - plane).abs() <= IN_THE_PLANE * size);
    let of_axis = |axis: usize| [(axis, 0, bounds.lower[axis]), (axis, 1, bounds.upper[axis])];
    let mut sides = (0..D).flat_map(of_axis);
    let (axis, end, _) = sides.find(|&(axis, _, plane)| within(axis, plane))?;
    Some(SIDES[axis][end].to_owned())
}

/// The hole that a facet is of: its vertices are on the sides of it.
fn hole<const D: usize>(holes: &[Vec<[f64; 2]>], corners: &[[f64; D]; D], size: f64) -> Option<String> {
    let is_of = |hole: &Vec<[f64; 2]>| {
        let polygon = Polygon { corners: hole.clone() };
        corners.iter().all(|x| polygon.distance(x).abs() <= IN_THE_PLANE * size)
    };
    Some(format!("hole-{}", holes.iter().position(is_of)? + 1))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::{Background, named_facets};
    use crate::scene::Scene;

    /// Names and areas of the groups.
    fn areas<const D: usize>(shape: &str) -> Vec<(String, f64)> {
        let body = format!(
            "{{ name = \"ball\", material = \"rubber\", shape = {{ kind = \"sphere\", centre = {:?}, radius = 0.1 }} }}",
            [0.0; D]
        );
        let text = format!(
            "title = \"a mesh\"\ndimension = {D}\ntransfer = {{ kind = \"apic\" }}\ntime = {{ end = 1.0 }}\noutput = {{ interval = 1.0 }}\n\
            materials.rubber = {{ law = \"neo-hookean\", density = 1.0, young_modulus = 1.0, poisson_ratio = 0.3 }}\nmesh = {{ generate = {shape} }}\nbodies = [{body}]\n"
        );
        let scene = Scene::parse(&text, Path::new("mesh.toml")).expect("a scene");
        let Background::Mesh { inner, groups, .. } = Background::<D>::build(&scene).expect("a mesh") else {
            panic!("no mesh");
        };
        let area = |facets: &[u32]| named_facets(&inner, facets).map(|facet| facet.area).sum();
        groups
            .iter()
            .map(|(name, facets)| (name.clone(), area(facets)))
            .collect()
    }

    fn has<const D: usize>(shape: &str, expected: &[(&str, f64)]) {
        let found = areas::<D>(shape);
        let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, expected.iter().map(|(name, _)| *name).collect::<Vec<_>>());
        for ((name, area), (_, exact)) in found.iter().zip(expected) {
            assert!((area - exact).abs() < 1e-9, "{name}: {area} for {exact}");
        }
    }

    #[test]
    fn straight_sides_and_holes_are_groups() {
        has::<1>(
            "{ kind = \"segments\", start = 0.5, end = 2.0, size = 0.3 }",
            &[("boundary", 2.0), ("x-lower", 1.0), ("x-upper", 1.0)],
        );
        has::<2>(
            "{ kind = \"polygon\", corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 2.0]], holes = [[[0.5, 0.5], [1.0, 0.5], [1.0, 1.0]], [[2.0, 0.4], [2.3, 0.4], [2.3, 0.8]]], size = 0.2 }",
            &[
                ("boundary", 6.0 + 10_f64.sqrt() + 1.0 + 0.5_f64.sqrt() + 1.2),
                ("hole-1", 1.0 + 0.5_f64.sqrt()),
                ("hole-2", 1.2),
                ("x-lower", 2.0),
                ("x-upper", 1.0),
                ("y-lower", 3.0),
            ],
        );
        has::<3>(
            "{ kind = \"box\", lower = [0.0, 0.0, 0.0], upper = [1.0, 2.0, 3.0], size = 0.5 }",
            &[
                ("boundary", 22.0),
                ("x-lower", 6.0),
                ("x-upper", 6.0),
                ("y-lower", 3.0),
                ("y-upper", 3.0),
                ("z-lower", 2.0),
                ("z-upper", 2.0),
            ],
        );
        let disk = areas::<2>("{ kind = \"disk\", centre = [0.0, 0.0], radius = 1.0, size = 2.0 }");
        assert_eq!(disk.len(), 1, "{disk:?}");
    }
}
