//! How long edges and how regular cells come out, over targets, angles and shapes.

use mpm_mesh::generate::{EdgeTarget, ball, cuboid, disk, extruded, polygon, rectangle, slope, wavy_channel};
use mpm_mesh::{SimplexMesh, generate::with_outer_layer};

use super::samples;

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
            ("channel", wavy_channel([0.0, 23.5], &target)),
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
    let prisms = Bounds {
        smallest_angle: 20.0,
        radius_ratio: 0.45,
        mean_radius_ratio: 0.75,
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
        ("slope", slope(5.0, 10.0, 15.0, 2.0, 1.0), 1.0, &prisms),
        ("ball", ball([0.0; 3], 1.0, 1.0), 1.0, &round),
        ("ball", ball([0.0; 3], 1.0, 0.25), 0.25, &round),
        ("ball", ball([0.0; 3], 1.0, 0.1), 0.1, &round),
    ] {
        let mesh = mesh.expect(name);
        holds(name, &mesh, length, bounds);
        // Convex edges and corners of the body spoil a few cells of the layer; a ball has none.
        let smooth = name == "ball";
        let (whole, _) = with_outer_layer(&mesh).expect(name);
        let layered = Bounds {
            smallest_angle: if smooth { 25.0 } else { 8.0 },
            radius_ratio: if smooth { 0.39 } else { 0.07 },
            mean_radius_ratio: if smooth { 0.6 } else { 0.7 },
            longest: 3.0,
        };
        holds(name, &whole, length, &layered);
    }
}

#[test]
fn a_prism_on_an_equilateral_triangle() {
    let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]];
    let base = SimplexMesh::new(corners, vec![0, 1, 2]).expect("a cell");
    let prism = extruded(&base, 1.0, 1.0).expect("a prism");
    let ratios: Vec<f64> = (0..3).map(|cell| prism.quality(cell).radius_ratio).collect();
    for (ratio, expected) in ratios.iter().zip([0.81, 0.73, 0.81]) {
        assert!((ratio - expected).abs() < 0.005, "{ratios:?}");
    }
    let worst = prism.quality_summary().worst;
    assert!((worst.smallest_angle.to_degrees() - 41.0).abs() < 0.5, "{worst:?}");
    assert!((worst.largest_angle.to_degrees() - 112.0).abs() < 0.5, "{worst:?}");
}

/// The body-centred lattice inside a box, and what doc comments say of it.
#[test]
fn inside_a_box_every_cell_is_the_lattices() {
    let mesh = cuboid([0.0; 3], [1.0; 3], 0.25).expect("a box");
    let boundary = mesh.on_boundary();
    let inner = (0..mesh.cell_count()).filter(|&cell| mesh.cell(cell).iter().all(|&v| !boundary[v as usize]));
    let qualities: Vec<_> = inner.map(|cell| mesh.quality(cell)).collect();
    assert!(!qualities.is_empty());
    for quality in qualities {
        assert!((quality.radius_ratio - 0.9f64.sqrt()).abs() < 1e-12, "{quality:?}");
        assert!((quality.smallest_angle.to_degrees() - 60.0).abs() < 1e-9, "{quality:?}");
        assert!((quality.largest_angle.to_degrees() - 90.0).abs() < 1e-9, "{quality:?}");
    }
}

/// Nothing goes by absolute size, or by the thickness of the whole.
#[test]
fn plates_far_thinner_than_wide_are_meshes() {
    let plate = cuboid([0.0; 3], [1.0, 1.0, 1e-9], 0.05).expect("a plate");
    assert!((plate.total_volume() / 1e-9 - 1.0).abs() < 1e-9);
    let tiny = cuboid([0.0; 3], [1e-30; 3], 2.5e-31).expect("a box");
    assert!((tiny.total_volume() / 1e-90 - 1.0).abs() < 1e-9);
}

/// The lengths that docs/results/umls and the expansion's scene state.
#[test]
fn the_ball_of_the_expansion_has_the_edges_that_are_published() {
    let inner = ball([0.0; 3], 0.5, 0.025).unwrap();
    let whole = with_outer_layer(&inner).unwrap().0;
    assert_eq!(inner.cells().len(), 160_000);
    assert!((inner.edge_lengths().mean - 0.0318).abs() < 5e-5);
    assert!((whole.edge_lengths().shortest - 0.0184).abs() < 5e-5);
}
