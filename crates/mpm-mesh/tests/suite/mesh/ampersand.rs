//! A domain with holes.

use mpm_mesh::generate::{EdgeTarget, ampersand};

#[test]
fn it_has_two_holes() {
    let target = EdgeTarget {
        length: 0.04,
        angle: 0.0,
    };
    let mesh = ampersand(1.0, &target).expect("a mesh");
    // That of the corners, which a unit test of `ampersand` adds up.
    let expected = 0.01 * 38.585;
    assert!(
        (mesh.total_volume() - expected).abs() < 1e-12,
        "{}",
        mesh.total_volume()
    );
    // Vertices − edges + cells = 1 − 2; every cell has three edges, which two cells share inside.
    let edges = (3 * mesh.cell_count() + mesh.boundary().len()) / 2;
    assert_eq!(mesh.vertices().len() + mesh.cell_count() + 1, edges);
    assert!(
        mesh.quality_summary().worst.radius_ratio > 0.5,
        "{:?}",
        mesh.quality_summary()
    );
    assert!(ampersand(-1.0, &target).is_err());
}
