//! How long edges and how regular cells come out, over targets, angles and shapes.

use mpm_mesh::generate::{EdgeTarget, ball, cuboid, disk, polygon, rectangle, slope, wavy_channel};
use mpm_mesh::{SimplexMesh, generate::with_outer_layer};

use crate::samples;

/// What a mesh has at the least.
struct Bounds {
    /// In degrees.
    smallest_angle: f64,
    radius_ratio: f64,
    mean_radius_ratio: f64,
    /// In units of the target.
    longest: f64,
}

fn holds<const D: usize>(name: &str, mesh: &SimplexMesh<D>, length: f64, bounds: &Bounds) {
    let summary = mesh.quality_summary();
    let edges = mesh.edge_lengths();
    let context = format!("{name} at {length}: {summary:?} {edges:?}");
    assert!(
        summary.worst.smallest_angle.to_degrees() >= bounds.smallest_angle,
        "{context}"
    );
    assert!(summary.worst.radius_ratio >= bounds.radius_ratio, "{context}");
    assert!(summary.mean_radius_ratio >= bounds.mean_radius_ratio, "{context}");
    assert!(edges.longest <= bounds.longest * length, "{context}");
}

#[test]
fn triangles_are_near_to_equilateral() {
    for (length, angle) in [(0.2, 0.0), (0.2, 0.3), (0.07, 0.0), (0.07, 0.5)] {
        let target = EdgeTarget { length, angle };
        for (name, mesh) in [
            ("square", rectangle([0.0; 2], [1.0; 2], &target)),
            ("disk", disk([0.0; 2], 1.0, &target)),
            ("channel", wavy_channel(23.5, &target)),
            ("ell", polygon(&samples::ELL, &target)),
            ("star", polygon(&samples::star(), &target)),
        ] {
            let mesh = mesh.expect(name);
            // The star's corners are 50° wide, and the two triangles there share them.
            let bounds = Bounds {
                smallest_angle: 25.0,
                radius_ratio: 0.5,
                mean_radius_ratio: if length < 0.1 { 0.98 } else { 0.92 },
                longest: 1.5,
            };
            holds(name, &mesh, length, &bounds);
            let (whole, _) = with_outer_layer(&mesh).expect(name);
            holds(name, &whole, length, &bounds);
        }
    }
}

#[test]
fn tetrahedra_are_as_regular_as_their_lattice() {
    let straight = Bounds {
        smallest_angle: 44.9,
        radius_ratio: 0.64,
        mean_radius_ratio: 0.85,
        longest: 1.42,
    };
    let sheared = Bounds {
        smallest_angle: 15.0,
        radius_ratio: 0.2,
        mean_radius_ratio: 0.8,
        longest: 1.75,
    };
    let round = Bounds {
        smallest_angle: 38.0,
        radius_ratio: 0.7,
        mean_radius_ratio: 0.87,
        longest: 1.85,
    };
    for (name, mesh, length, bounds) in [
        ("cuboid", cuboid([0.0; 3], [1.0, 1.0, 2.0], 0.25), 0.25, &straight),
        ("slope", slope(5.0, 10.0, 15.0, 2.0, 1.0), 1.0, &sheared),
        ("ball", ball([0.0; 3], 1.0, 1.0), 1.0, &round),
        ("ball", ball([0.0; 3], 1.0, 0.25), 0.25, &round),
        ("ball", ball([0.0; 3], 1.0, 0.1), 0.1, &round),
    ] {
        holds(name, &mesh.expect(name), length, bounds);
    }
}
