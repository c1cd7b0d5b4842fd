//! First rings and adjacency against their definitions.

use std::collections::BTreeSet;

use mpm_mesh::{Rings, SimplexMesh};

use super::samples;

#[test]
fn rings_and_adjacency_are_what_they_are_defined_as() {
    samples::one_dimensional().iter().for_each(|sample| check(&sample.mesh));
    samples::two_dimensional().iter().for_each(|sample| check(&sample.mesh));
    samples::three_dimensional()
        .iter()
        .for_each(|sample| check(&sample.mesh));
}

fn check<const D: usize>(mesh: &SimplexMesh<D>) {
    let (cells, joined, rings) = (mesh.vertex_cells(), mesh.vertex_neighbours(), Rings::new(mesh));
    for vertex in 0..mesh.vertices().len() as u32 {
        let with = (0..mesh.cell_count() as u32).filter(|&cell| mesh.cell(cell as usize).contains(&vertex));
        assert_eq!(cells.get(vertex as usize), with.clone().collect::<Vec<_>>());
        let around: BTreeSet<u32> = with.flat_map(|cell| mesh.cell(cell as usize).to_vec()).collect();
        let others: Vec<u32> = around.into_iter().filter(|&other| other != vertex).collect();
        assert_eq!(joined.get(vertex as usize), others);
    }
    for (number, cell) in mesh.cells().enumerate() {
        let touching = mesh.cells().filter(|other| other.iter().any(|v| cell.contains(v)));
        let ring: BTreeSet<u32> = touching.flatten().copied().collect();
        assert_eq!(rings.ring(number), ring.into_iter().collect::<Vec<_>>());
        assert!(rings.ring(number).len() <= rings.largest());
    }
    let edges = mesh.edges();
    assert!(edges.is_sorted() && edges.iter().all(|[a, b]| a < b));
    assert_eq!(2 * edges.len(), joined.items().len());
}

#[test]
fn edge_lengths_of_a_square() {
    let lengths = samples::square().edge_lengths();
    assert_eq!(lengths.shortest, 1.0);
    assert_eq!(lengths.longest, 2f64.sqrt());
    assert!((lengths.mean - (4.0 + 2f64.sqrt()) / 5.0).abs() < 1e-15);
}

#[test]
fn regular_simplices_have_quality_one() {
    let triangle = SimplexMesh::new(vec![[0.0, 0.0], [2.0, 0.0], [1.0, 3f64.sqrt()]], vec![0, 1, 2]).expect("a cell");
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
    let tetrahedron = SimplexMesh::new(corners, vec![0, 1, 2, 3]).expect("a cell");
    for (quality, angle) in [
        (samples::unit::<1>().quality(0), 0.0),
        (triangle.quality(0), 0.5f64.acos()),
        (tetrahedron.quality(0), (1.0 / 3.0f64).acos()),
    ] {
        assert!((quality.radius_ratio - 1.0).abs() < 1e-14);
        assert!((quality.smallest_angle - angle).abs() < 1e-14);
        assert!((quality.largest_angle - angle).abs() < 1e-14);
    }
}
