//! Layers of mirrored cells.

use mpm_mesh::generate::{EdgeTarget, cuboid, rectangle, segments, with_mirrored_layer};
use mpm_mesh::{MeshBasis, SimplexMesh};
use mpm_tensor::vector::{add_scaled, distance, dot};

/// On the plane the weights of images are equal, and nodes without an image have none.
fn check<const D: usize>(mesh: &SimplexMesh<D>, normal: [f64; D], points: &[[f64; D]]) {
    let whole = with_mirrored_layer(mesh, &[0.0; D], &normal)
        .expect("valid")
        .expect("ends there");
    assert_eq!(whole.vertices()[..mesh.vertices().len()], *mesh.vertices());
    assert!((0..mesh.cell_count()).all(|cell| whole.cell(cell) == mesh.cell(cell)));
    let basis = MeshBasis::new(&whole).expect("valid");
    for x in points {
        let weights = basis.weights_at(x).expect("on the plane");
        let position = |vertex: u32| &basis.mesh().vertices()[vertex as usize];
        for weight in &weights {
            let node = position(weight.vertex);
            let image = add_scaled(node, -2.0 * dot(node, &normal), &normal);
            let other = weights
                .iter()
                .find(|other| distance(position(other.vertex), &image) < 1e-9);
            let expected = other.map_or(0.0, |other| other.entry.weight);
            assert!((weight.entry.weight - expected).abs() < 1e-11, "{x:?}: {node:?}");
        }
    }
}

#[test]
fn weights_are_symmetric_on_the_plane() {
    check(&segments(0.0, &[0.5, 0.4, 0.3, 0.5]).expect("valid"), [1.0], &[[0.0]]);
    let target = EdgeTarget {
        length: 0.21,
        angle: 0.0,
    };
    let plane = rectangle([0.0, -1.0], [1.0, 1.0], &target).expect("valid");
    check(&plane, [1.0, 0.0], &[[0.0, 0.03], [0.0, -0.3], [0.0, 0.41]]);
    let (cosine, sine) = (0.8, 0.6);
    let turn = |x: &[f64; 2]| [cosine * x[0] - sine * x[1], sine * x[0] + cosine * x[1]];
    let vertices = plane.vertices().iter().map(turn).collect();
    let turned = SimplexMesh::new(vertices, plane.cells().flatten().copied().collect()).expect("valid");
    check(&turned, [cosine, sine], &[turn(&[0.0, 0.03]), turn(&[0.0, -0.3])]);
    let space = cuboid([0.0, -1.0, -1.0], [1.0, 1.0, 1.0], 0.4).expect("valid");
    check(&space, [1.0, 0.0, 0.0], &[[0.0, 0.03, 0.1], [0.0, -0.3, 0.2]]);
}

#[test]
fn two_planes_make_a_corner() {
    let target = EdgeTarget {
        length: 0.25,
        angle: 0.0,
    };
    let mesh = rectangle([0.0, 0.0], [1.0, 1.0], &target).expect("valid");
    let side = with_mirrored_layer(&mesh, &[0.0, 0.0], &[1.0, 0.0])
        .expect("valid")
        .expect("ends there");
    let corner = with_mirrored_layer(&side, &[0.0, 0.0], &[0.0, 1.0])
        .expect("valid")
        .expect("ends there");
    let origin = corner
        .vertices()
        .iter()
        .position(|x| *x == [0.0, 0.0])
        .expect("a corner");
    assert!(!corner.on_boundary()[origin]);
}

#[test]
fn a_mesh_that_goes_on_is_left_alone() {
    let mesh = segments(-1.0, &[0.5, 0.5, 0.5]).expect("valid");
    for position in [-0.5, 7.0] {
        assert_eq!(with_mirrored_layer(&mesh, &[position], &[1.0]).expect("valid"), None);
    }
}
