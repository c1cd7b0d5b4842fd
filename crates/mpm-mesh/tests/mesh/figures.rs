//! The shape of generated cells, with what it was measured to be.

use mpm_mesh::generate::{EdgeTarget, disk, polygon, rectangle, wavy_channel};
use mpm_mesh::{QualitySummary, SimplexMesh};

pub fn show<const D: usize>(name: &str, mesh: &SimplexMesh<D>, length: f64) {
    let QualitySummary {
        worst,
        mean_radius_ratio,
        ..
    } = mesh.quality_summary();
    let edges = mesh.edge_lengths();
    eprintln!(
        "{name}: {} cells, angles {:.1}..{:.1}, radius ratio min {:.3} mean {mean_radius_ratio:.3}, edges {:.3} {:.3} {:.3}",
        mesh.cell_count(),
        worst.smallest_angle.to_degrees(),
        worst.largest_angle.to_degrees(),
        worst.radius_ratio,
        edges.shortest / length,
        edges.mean / length,
        edges.longest / length
    );
}

#[test]
fn figures_2d() {
    for (length, angle) in [(0.2, 0.0), (0.2, 0.3), (0.07, 0.0), (0.07, 0.5)] {
        let target = EdgeTarget { length, angle };
        show("square", &rectangle([0.0; 2], [1.0; 2], &target).unwrap(), length);
        show("disk", &disk([0.0; 2], 1.0, &target).unwrap(), length);
        show("channel", &wavy_channel(23.5, &target).unwrap(), length);
        let ell = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        show("ell", &polygon(&ell, &target).unwrap(), length);
        let star: Vec<[f64; 2]> = (0..10)
            .map(|k| {
                let r = if k % 2 == 0 { 1.0 } else { 0.5 };
                let a = k as f64 * std::f64::consts::PI / 5.0;
                [r * a.cos(), r * a.sin()]
            })
            .collect();
        show("star", &polygon(&star, &target).unwrap(), length);
    }
}

#[test]
fn figures_layer() {
    use mpm_mesh::generate::with_outer_layer;
    for (length, angle) in [(0.2, 0.0), (0.2, 0.3), (0.07, 0.5)] {
        let target = EdgeTarget { length, angle };
        let star: Vec<[f64; 2]> = (0..10)
            .map(|k| {
                let r = if k % 2 == 0 { 1.0 } else { 0.5 };
                let a = k as f64 * std::f64::consts::PI / 5.0;
                [r * a.cos(), r * a.sin()]
            })
            .collect();
        for (name, mesh) in [
            ("square", rectangle([0.0; 2], [1.0; 2], &target).unwrap()),
            ("disk", disk([0.0; 2], 1.0, &target).unwrap()),
            ("channel", wavy_channel(23.5, &target).unwrap()),
            ("star", polygon(&star, &target).unwrap()),
        ] {
            let (whole, layer) = with_outer_layer(&mesh).unwrap();
            show(name, &whole, length);
            eprintln!("   {} {}", layer.first_cell, whole.cell_count());
        }
    }
    let (whole, _) = with_outer_layer(&crate::samples::frame()).unwrap();
    show("frame", &whole, 1.0);
    let (whole, _) = with_outer_layer(&crate::samples::unit::<3>()).unwrap();
    show("tet", &whole, 1.0);
    let (whole, _) = with_outer_layer(&crate::samples::unit::<1>()).unwrap();
    show("segment", &whole, 1.0);
}
#[test]
fn figures_3d() {
    use mpm_mesh::generate::{ball, cuboid, slope, with_outer_layer};
    for (name, mesh, length) in [
        ("cuboid", cuboid([0.0; 3], [1.0, 1.0, 2.0], 0.25).unwrap(), 0.25),
        ("slope", slope(5.0, 10.0, 15.0, 2.0, 1.0).unwrap(), 1.0),
        ("slope", slope(5.0, 10.0, 15.0, 2.0, 0.5).unwrap(), 0.5),
        ("ball", ball([0.0; 3], 1.0, 1.0).unwrap(), 1.0),
        ("ball", ball([0.0; 3], 1.0, 0.5).unwrap(), 0.5),
        ("ball", ball([0.0; 3], 1.0, 0.25).unwrap(), 0.25),
        ("ball", ball([0.0; 3], 1.0, 0.1).unwrap(), 0.1),
    ] {
        show(name, &mesh, length);
        let (whole, _) = with_outer_layer(&mesh).unwrap();
        show("   ...with layer", &whole, length);
    }
}
