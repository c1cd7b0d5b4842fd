//! From the tables of a scene to meshes.

use std::any::Any;

use mpm_document::fingerprint;
use mpm_mesh::generate::{
    EdgeTarget, GenerationError, Refinement, Scatter, SizeField, ball, circle_outline, cuboid, cyclic_sizes,
    disk_outline, outlines, rectangle_outline, scattered, segments, slope, triangle_lattice, wavy_channel_outline,
};
use mpm_mesh::{NamedMesh, SimplexMesh, read_named_msh};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::sides::sides;
use crate::SceneFault;
use crate::rotation::Rotation;
use crate::scene::{DelaunayTable, MeshShapeTable, MeshTable, RefinementTable, Scene, ShapeTable};
use crate::shape::{Polygon, Shape};

/// The group of all facets of the boundary, unless a file has one of this name.
const BOUNDARY: &str = "boundary";

/// The mesh of a scene without an outer layer, the groups of its facets, and the fingerprint of its file where it has one.
pub(super) fn inner<const D: usize>(
    scene: &Scene,
    table: &MeshTable,
    rotation: Option<&Rotation<D>>,
) -> Result<(NamedMesh<D>, Option<u64>), SceneFault> {
    let (named, contents) = match (&table.file, &table.generate) {
        (Some(_), _) => {
            let (named, contents) = read::<D>(scene, table)?;
            (named, Some(contents))
        }
        (None, Some(shape)) => {
            check_holes(shape)?;
            let refused = |error| SceneFault::value("mesh.generate", shape, format!("a mesh: {error}"));
            let mesh = generate(shape, table.delaunay.as_ref(), table.angle.to_radians()).map_err(refused)?;
            let facets = sides(shape, &mesh);
            (NamedMesh { mesh, facets }, None)
        }
        (None, None) => return Err(SceneFault::missing("mesh.generate", "given unless file is")),
    };
    let NamedMesh { mesh, mut facets } = named;
    let all = || mesh.boundary().iter().flat_map(|facet| facet.vertices).collect();
    facets.entry(BOUNDARY.to_owned()).or_insert_with(all);
    let Some(rotation) = rotation else {
        return Ok((NamedMesh { mesh, facets }, contents));
    };
    let vertices = mesh.vertices().iter().map(|x| rotation.apply(x)).collect();
    let cells = mesh.cells().flatten().copied().collect();
    let mesh = SimplexMesh::new(vertices, cells).map_err(|error| {
        SceneFault::value(
            "mesh.rotation",
            &table.rotation,
            format!("one that keeps the mesh valid: {error}"),
        )
    })?;
    Ok((NamedMesh { mesh, facets }, contents))
}

/// Holes of polygons are inside of the outline, and of no other hole: elsewhere they would be islands.
fn check_holes(shape: &MeshShapeTable) -> Result<(), SceneFault> {
    let MeshShapeTable::Polygon { corners, holes, .. } = shape else {
        return Ok(());
    };
    let is_inside = |hole: &[[f64; 2]], corners: &[[f64; 2]]| {
        let polygon = Polygon {
            corners: corners.to_vec(),
        };
        hole.iter().all(|corner| Shape::<2>::distance(&polygon, corner) <= 0.0)
    };
    for (number, hole) in holes.iter().enumerate() {
        let others = holes.iter().enumerate().filter(|(other, _)| *other != number);
        let is_nested = others.into_iter().any(|(_, other)| is_inside(hole, other));
        if is_nested || !is_inside(hole, corners) {
            let field = format!("mesh.generate.holes[{number}]");
            return Err(SceneFault::value(
                field,
                hole,
                "inside of the corners and of no other hole",
            ));
        }
    }
    Ok(())
}

/// The mesh of a file of Gmsh, beside the scene, and its fingerprint.
fn read<const D: usize>(scene: &Scene, table: &MeshTable) -> Result<(NamedMesh<D>, u64), SceneFault> {
    let Some(file) = &table.file else {
        return Err(SceneFault::missing("mesh.file", "given"));
    };
    let path = scene
        .file
        .parent()
        .map_or_else(|| file.clone(), |directory| directory.join(file));
    let unreadable = |error| {
        let expected = format!("a file that can be read, and {} cannot: {error}", path.display());
        SceneFault::value("mesh.file", file, expected)
    };
    let bytes = std::fs::read(&path).map_err(unreadable)?;
    let named = read_named_msh(&bytes)
        .map_err(|error| SceneFault::value("mesh.file", file, format!("a mesh of the scene: {error}")))?;
    Ok((named, fingerprint(&bytes)))
}

/// The mesh that a table describes, with random points where there is a table for them, and edges inside along an angle in radians.
fn generate<const D: usize>(
    table: &MeshShapeTable,
    delaunay: Option<&DelaunayTable>,
    angle: f64,
) -> Result<SimplexMesh<D>, GenerationError> {
    let length = table.size();
    let field = || size_field(length, delaunay);
    let plane = |polygons: Vec<Vec<[f64; 2]>>| match delaunay {
        None => as_dimension(outlines(&polygons, &EdgeTarget { length, angle })?),
        Some(delaunay) => as_dimension(of_random_points(&polygons, &field()?, delaunay, angle)?),
    };
    match table {
        MeshShapeTable::Segments {
            start,
            end,
            size,
            pattern,
        } => {
            let count = ((end - start) / size).round().max(1.0);
            let sizes = cyclic_sizes(end - start, count as usize, pattern)?;
            as_dimension(segments(*start, &sizes)?)
        }
        MeshShapeTable::Lattice { lower, upper, size } => as_dimension(triangle_lattice(*lower, *upper, *size)?),
        MeshShapeTable::Box { lower, upper, size } => as_dimension(cuboid(*lower, *upper, *size)?),
        MeshShapeTable::Slope {
            height,
            crest,
            base,
            width,
            size,
        } => as_dimension(slope(*height, *crest, *base, *width, *size)?),
        MeshShapeTable::Ball { centre, radius, size } => as_dimension(ball(*centre, *radius, *size)?),
        MeshShapeTable::Rectangle { lower, upper, .. } => plane(vec![rectangle_outline(*lower, *upper)?]),
        MeshShapeTable::Polygon { corners, holes, .. } => {
            plane(std::iter::once(corners).chain(holes).cloned().collect())
        }
        MeshShapeTable::Disk { centre, radius, size } => plane(vec![disk_outline(*centre, *radius, *size)?]),
        MeshShapeTable::Ring {
            centre, inner, outer, ..
        } => {
            let field = field()?;
            let rim = |radius: f64| circle_outline(*centre, radius, &field);
            plane(vec![rim(*outer)?, rim(*inner)?])
        }
        MeshShapeTable::Channel { floor, height, size } => plane(vec![wavy_channel_outline([*floor, *height], *size)?]),
    }
}

/// A length, with the places where edges are shorter.
fn size_field(length: f64, table: Option<&DelaunayTable>) -> Result<SizeField, GenerationError> {
    let refinement = |place: &RefinementTable| Refinement {
        centre: place.centre,
        radius: place.radius,
        size: place.size,
        growth: place.growth,
    };
    let places = table.iter().flat_map(|table| &table.refine);
    SizeField::new(length, places.map(refinement).collect())
}

/// A Delaunay mesh of random points between polygons.
fn of_random_points(
    polygons: &[Vec<[f64; 2]>],
    field: &SizeField,
    table: &DelaunayTable,
    angle: f64,
) -> Result<SimplexMesh<2>, GenerationError> {
    let mut generator = ChaCha8Rng::seed_from_u64(table.seed);
    let sweeps = table.sweeps;
    scattered(polygons, field, Scatter { sweeps, angle }, &mut || generator.random())
}

/// The mesh as one of D dimensions, which it is.
fn as_dimension<const D: usize, const E: usize>(mesh: SimplexMesh<E>) -> Result<SimplexMesh<D>, GenerationError> {
    let mesh: Box<dyn Any> = Box::new(mesh);
    let mesh = mesh.downcast::<SimplexMesh<D>>();
    mesh.map(|mesh| *mesh).map_err(|_| GenerationError::InvalidParameter {
        name: "dimension of the mesh",
        value: E as f64,
        requirement: "that of the scene",
    })
}

/// A mesh of a body with edges of length `size`.
///
/// # Errors
/// [`SceneFault::Value`] for shapes that there are no meshes of.
pub(crate) fn of_shape<const D: usize>(
    field: &str,
    shape: &ShapeTable,
    size: f64,
) -> Result<SimplexMesh<D>, SceneFault> {
    let expected = "a box, a sphere or a polygon where a mesh of it is asked for";
    let refused = || SceneFault::value(field, shape, expected);
    let table = match shape {
        ShapeTable::Box { lower, upper } => match (&lower[..], &upper[..]) {
            (&[start], &[end]) => MeshShapeTable::Segments {
                start,
                end,
                size,
                pattern: vec![1.0],
            },
            (&[x, y], &[right, top]) => MeshShapeTable::Rectangle {
                lower: [x, y],
                upper: [right, top],
                size,
            },
            (&[x, y, z], &[right, top, back]) => MeshShapeTable::Box {
                lower: [x, y, z],
                upper: [right, top, back],
                size,
            },
            _ => return Err(refused()),
        },
        ShapeTable::Sphere { centre, radius } => match (&centre[..], *radius) {
            (&[x, y], radius) => MeshShapeTable::Disk {
                centre: [x, y],
                radius,
                size,
            },
            (&[x, y, z], radius) => MeshShapeTable::Ball {
                centre: [x, y, z],
                radius,
                size,
            },
            _ => return Err(refused()),
        },
        ShapeTable::Polygon { corners } => MeshShapeTable::Polygon {
            corners: corners.clone(),
            holes: Vec::new(),
            size,
        },
        _ => return Err(refused()),
    };
    generate(&table, None, 0.0)
        .map_err(|error| SceneFault::value(field, shape, format!("a shape that has a mesh: {error}")))
}
