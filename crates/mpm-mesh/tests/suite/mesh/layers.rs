//! Outer layers: the mesh inside is as it was, and nothing of it is left on the boundary.

use mpm_mesh::generate::{EdgeTarget, GenerationError, OuterLayer, polygon, with_outer_layer};
use mpm_mesh::{NO_CELL, Rings, SimplexMesh};

use super::conformance;
use super::samples::{self, Sample, sample};

#[test]
fn around_every_mesh() {
    samples::one_dimensional().iter().for_each(check);
    samples::two_dimensional().iter().for_each(check);
    samples::three_dimensional().iter().for_each(check);
}

fn check<const D: usize>(sample: &Sample<D>) {
    let Sample { name, mesh, .. } = sample;
    let (whole, layer) = with_outer_layer(mesh).unwrap_or_else(|error| panic!("{name}: {error}"));
    let inside = OuterLayer {
        first_vertex: mesh.vertices().len(),
        first_cell: mesh.cell_count(),
    };
    assert_eq!(layer, inside, "{name}");
    assert_eq!(&whole.vertices()[..layer.first_vertex], mesh.vertices(), "{name}");
    assert!(whole.cells().zip(mesh.cells()).all(|(a, b)| a == b), "{name}");
    for cell in 0..mesh.cell_count() {
        assert!(!whole.neighbours(cell).contains(&NO_CELL), "{name}");
    }
    // Every cell of the layer touches the mesh, and so is in the ring of one of its cells.
    let touches = |cell: usize| whole.cell(cell).iter().any(|&v| (v as usize) < layer.first_vertex);
    assert!((layer.first_cell..whole.cell_count()).all(touches), "{name}");
    let boundary = whole.on_boundary();
    assert!(!boundary[..layer.first_vertex].contains(&true), "{name}");
    assert!(Rings::new(&whole).largest() >= Rings::new(mesh).largest(), "{name}");
    let volume = whole.total_volume();
    if *name != "pierced" && *name != "frame" && *name != "ring" {
        conformance::check(&self::sample(name, whole, volume, sample.euler));
    }
}

#[test]
fn small_holes_are_filled() {
    let (whole, layer) = with_outer_layer(&samples::frame()).expect("a layer");
    let volume = whole.total_volume();
    assert!(volume > 9.0);
    conformance::check(&sample("filled frame", whole.clone(), volume, 1));
    assert_eq!(
        whole
            .neighbours(1)
            .iter()
            .filter(|&&n| n as usize >= layer.first_cell)
            .count(),
        1
    );
}

/// A slit narrower than the edges beside it, and a notch of 20°.
#[test]
fn narrow_bays_are_filled() {
    let slit = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 2.0],
        [2.1, 2.0],
        [2.1, 0.5],
        [1.9, 0.5],
        [1.9, 2.0],
        [0.0, 2.0],
    ];
    let notch = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 2.0],
        [2.3, 2.0],
        [2.0, 0.5],
        [1.7, 2.0],
        [0.0, 2.0],
    ];
    for corners in [slit.as_slice(), &notch] {
        let target = EdgeTarget {
            length: 0.4,
            angle: 0.0,
        };
        let mesh = polygon(corners, &target).expect("a mesh");
        check(&sample("bay", mesh, samples::polygon_area(corners), 1));
    }
}

/// Intervals 0.01 apart have no room for layers of full length.
#[test]
fn heights_are_reduced_between_close_parts() {
    let mesh = SimplexMesh::new(vec![[0.0], [1.0], [1.01], [2.0]], vec![0, 1, 2, 3]).expect("a mesh");
    let (whole, layer) = with_outer_layer(&mesh).expect("a layer");
    assert!((layer.first_cell..whole.cell_count()).all(|cell| whole.volume(cell) < 0.01));
    let close = SimplexMesh::new(vec![[0.0], [1.0], [1.0001], [2.0]], vec![0, 1, 2, 3]).expect("a mesh");
    assert!(matches!(with_outer_layer(&close), Err(GenerationError::Mesh(_))));
}
