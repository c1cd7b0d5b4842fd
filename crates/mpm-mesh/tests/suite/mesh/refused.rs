//! Meshes that are no meshes, each with the error it is refused with.

use mpm_mesh::{MeshError, SimplexMesh};

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

fn refused<const D: usize>(vertices: &[[f64; D]], cells: &[u32]) -> MeshError {
    SimplexMesh::new(vertices.to_vec(), cells.to_vec()).expect_err("not a mesh")
}

/// The square and further vertices.
fn with(more: &[[f64; 2]]) -> Vec<[f64; 2]> {
    [&SQUARE, more].concat()
}

#[test]
fn lists_that_do_not_fit() {
    assert_eq!(refused::<2>(&[], &[]), MeshError::Empty { what: "vertices" });
    assert_eq!(refused(&SQUARE, &[]), MeshError::Empty { what: "cells" });
    let dimension = MeshError::UnsupportedDimension { dimension: 4 };
    assert_eq!(refused(&[[0.0; 4]], &[0, 0, 0, 0, 0]), dimension);
    assert_eq!(
        refused::<0>(&[[]], &[0]),
        MeshError::UnsupportedDimension { dimension: 0 }
    );
    let ragged = MeshError::RaggedCells { count: 4, per_cell: 3 };
    assert_eq!(refused(&SQUARE, &[0, 1, 2, 0]), ragged);
    let unknown = MeshError::UnknownVertex {
        cell: 1,
        vertex: 4,
        vertex_count: 4,
    };
    assert_eq!(refused(&SQUARE, &[0, 1, 2, 0, 2, 4]), unknown);
    let unknown = MeshError::UnknownVertex {
        cell: 0,
        vertex: 4,
        vertex_count: 4,
    };
    assert_eq!(SimplexMesh::from_used(&SQUARE, &[0, 1, 4]), Err(unknown));
}

#[test]
fn vertices_that_are_no_vertices() {
    let mut vertices = with(&[]);
    vertices[3][1] = f64::INFINITY;
    let position = vec![0.0, f64::INFINITY];
    let error = MeshError::NonFiniteVertex { vertex: 3, position };
    assert_eq!(refused(&vertices, &[0, 1, 2, 0, 2, 3]), error);
    assert_eq!(refused(&SQUARE, &[0, 1, 2]), MeshError::UnusedVertex { vertex: 3 });
    let used = SimplexMesh::from_used(&SQUARE, &[0, 2, 3]).expect("a mesh");
    assert_eq!(used.vertices(), [SQUARE[0], SQUARE[2], SQUARE[3]]);
    assert_eq!(used.cell(0), [0, 1, 2]);
    let twice = with(&[SQUARE[0], SQUARE[2]]);
    let error = MeshError::DuplicateVertices { first: 0, second: 4 };
    assert_eq!(refused(&twice, &[0, 1, 2, 4, 5, 3]), error);
}

#[test]
fn cells_that_are_no_cells() {
    let error = MeshError::RepeatedVertex { cell: 1, vertex: 2 };
    assert_eq!(refused(&SQUARE, &[0, 1, 2, 2, 3, 2]), error);
    let error = MeshError::InvertedCell { cell: 1, volume: -0.5 };
    assert_eq!(refused(&SQUARE, &[0, 1, 2, 0, 3, 2]), error);
    let error = MeshError::InvertedCell { cell: 0, volume: -2.0 };
    assert_eq!(refused(&[[1.0], [-1.0]], &[0, 1]), error);
    let error = MeshError::FlatCell {
        cell: 0,
        volume: 0.0,
        longest_edge: 2.0,
    };
    assert_eq!(refused(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], &[0, 1, 2]), error);
    let huge = refused(&[[0.0, 0.0], [1e300, 0.0], [0.0, 1e300]], &[0, 1, 2]);
    assert!(matches!(huge, MeshError::FlatCell { cell: 0, .. }), "{huge}");
}

#[test]
fn cells_that_do_not_fit_together() {
    let error = MeshError::DuplicateCells { first: 0, second: 2 };
    assert_eq!(refused(&SQUARE, &[0, 1, 2, 0, 2, 3, 1, 2, 0]), error);
    let error = MeshError::OverlappingCells {
        first: 0,
        second: 1,
        facet: vec![0, 1],
    };
    assert_eq!(refused(&SQUARE, &[0, 1, 2, 0, 1, 3]), error);
    let error = MeshError::NonManifoldFacet {
        facet: vec![0, 2],
        cells: vec![0, 1, 2],
    };
    assert_eq!(refused(&with(&[[2.0, -1.0]]), &[0, 1, 2, 0, 2, 3, 0, 4, 2]), error);
    let error = MeshError::OverlappingCells {
        first: 0,
        second: 1,
        facet: vec![0],
    };
    assert_eq!(refused(&[[0.0], [1.0], [2.0]], &[0, 1, 0, 2]), error);
}

#[test]
fn cells_with_others_vertices_in_them() {
    // The diagonal of the square has a vertex on it that one side only knows.
    let error = MeshError::HangingVertex { vertex: 4, cell: 0 };
    assert_eq!(refused(&with(&[[0.5, 0.5]]), &[0, 1, 2, 0, 4, 3, 4, 2, 3]), error);
    let error = MeshError::VertexInsideCell { vertex: 4, cell: 0 };
    assert_eq!(refused(&with(&[[0.6, 0.4]]), &[0, 1, 2, 0, 4, 3, 4, 2, 3]), error);
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let below = [[0.0, 0.0, -1.0], [0.5, 0.0, 0.0]];
    let vertices = [corners.as_slice(), &below].concat();
    let error = MeshError::HangingVertex { vertex: 5, cell: 0 };
    assert_eq!(refused(&vertices, &[0, 1, 2, 3, 0, 2, 5, 4]), error);
    assert_eq!(refused(&[[0.0], [2.0], [1.0], [3.0]], &[0, 1, 2, 3]), {
        MeshError::VertexInsideCell { vertex: 2, cell: 0 }
    });
}
