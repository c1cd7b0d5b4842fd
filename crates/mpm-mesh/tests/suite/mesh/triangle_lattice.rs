//! Rows of triangles.

use mpm_mesh::MeshBasis;
use mpm_mesh::generate::{triangle_lattice, with_mirrored_layer, with_outer_layer};

/// 12 × 14 and so on: edges, sides and angles.
#[test]
fn triangles_are_as_near_to_equilateral_as_the_width_allows() {
    for (lower, upper, length) in [
        ([0.0, -9.0], [12.0, 5.0], 0.5),
        ([0.0, -9.0], [12.0, 5.0], 2.0),
        ([-1.0, 2.0], [0.3, 2.1], 0.07),
        ([0.0, 0.0], [3f64.sqrt(), 2.0], 1.0),
    ] {
        let mesh = triangle_lattice(lower, upper, length).expect("a mesh");
        let edges = mesh.edge_lengths();
        assert!((edges.longest / length - 1.0).abs() < 1e-12, "{edges:?}");
        assert!(edges.shortest > 0.9 * length, "{edges:?}");
        assert!(mesh.quality_summary().worst.radius_ratio > 0.95);
        let x = |choose: fn(f64, f64) -> f64, start| mesh.vertices().iter().fold(start, |x, v| choose(x, v[0]));
        assert_eq!((x(f64::min, f64::MAX), x(f64::max, f64::MIN)), (lower[0], upper[0]));
        // The area of its columns: all triangles have the same.
        let each = mesh.volume(0);
        assert!((0..mesh.cell_count()).all(|cell| (mesh.volume(cell) / each - 1.0).abs() < 1e-9));
    }
}

#[test]
fn it_covers_the_rectangle() {
    let mesh = triangle_lattice([-1.0, -1.0], [1.0, 0.7], 0.3).expect("a mesh");
    let basis = MeshBasis::new(&mesh).expect("valid");
    for k in 0..=400 {
        let x = [-1.0 + 0.1 * f64::from(k % 21), -1.0 + 1.7 / 19.0 * f64::from(k / 21)];
        assert!(basis.search().locate(&x, None).is_some(), "{x:?}");
    }
}

/// Images of the cells keep the longest edge, and with it the kernel; cells around the rest hardly change it.
#[test]
fn layers_fit() {
    let mesh = triangle_lattice([0.0, -9.0], [12.0, 5.0], 0.5).expect("a mesh");
    let walled = with_mirrored_layer(&mesh, &[0.0, 0.0], &[1.0, 0.0])
        .expect("valid")
        .expect("ends there");
    assert!((walled.edge_lengths().longest - 0.5).abs() < 1e-12);
    let walled = with_mirrored_layer(&walled, &[12.0, 0.0], &[-1.0, 0.0])
        .expect("valid")
        .expect("ends there");
    assert!((walled.edge_lengths().longest - 0.5).abs() < 1e-12);
    let (whole, _) = with_outer_layer(&walled).expect("a layer");
    assert!(whole.edge_lengths().longest < 0.6, "{:?}", whole.edge_lengths());
}

#[test]
fn numbers_out_of_range() {
    for (lower, upper, length) in [
        ([0.0, 0.0], [0.0, 1.0], 0.1),
        ([0.0, 0.0], [1.0, f64::NAN], 0.1),
        ([0.0, 0.0], [1.0, 1.0], 0.0),
        ([0.0, 0.0], [1.0, 1.0], 1e-6),
        ([0.0, 0.0], [1e-12, 1.0], 1.0),
    ] {
        assert!(
            triangle_lattice(lower, upper, length).is_err(),
            "{lower:?} {upper:?} {length}"
        );
    }
}
