//! How regular the meshes of the generators are, with and without their outer layer: `cargo run --release -p mpm-mesh --example shapes`.
//!
//! A line per mesh, as in the table of this crate's README: cells, angles between facets, radius ratios (least, mean), edges in units of the length asked for.

#![allow(clippy::print_stdout)]

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{
    EdgeTarget, GenerationError, ball, cuboid, disk, polygon, rectangle, slope, wavy_channel, with_outer_layer,
};

const ELL: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

fn print<const D: usize>(name: &str, mesh: &SimplexMesh<D>, length: f64) -> Result<(), GenerationError> {
    line(name, mesh, length);
    line("… and its layer", &with_outer_layer(mesh)?.0, length);
    Ok(())
}

fn line<const D: usize>(name: &str, mesh: &SimplexMesh<D>, length: f64) {
    let (shapes, edges) = (mesh.quality_summary(), mesh.edge_lengths());
    let [least, most] = [shapes.worst.smallest_angle, shapes.worst.largest_angle].map(f64::to_degrees);
    let [shortest, mean, longest] = [edges.shortest, edges.mean, edges.longest].map(|edge| edge / length);
    println!(
        "| {name} | {} | {least:.1}° to {most:.1}° | {:.3}, {:.3} | {shortest:.3}, {mean:.3}, {longest:.3} |",
        mesh.cell_count(),
        shapes.worst.radius_ratio,
        shapes.mean_radius_ratio,
    );
}

fn main() -> Result<(), GenerationError> {
    for (angle, turned) in [(0.0, ""), (0.4, ", lattice turned by 0.4")] {
        let target = EdgeTarget { length: 0.1, angle };
        print(
            &format!("unit square{turned}"),
            &rectangle([0.0; 2], [1.0; 2], &target)?,
            0.1,
        )?;
        print(&format!("disk, radius 1{turned}"), &disk([0.0; 2], 1.0, &target)?, 0.1)?;
        print(
            &format!("wavy channel, height 23.5{turned}"),
            &wavy_channel([0.0, 23.5], &target)?,
            0.1,
        )?;
        print(&format!("L-shaped plate{turned}"), &polygon(&ELL, &target)?, 0.1)?;
    }
    print("unit cube", &cuboid([0.0; 3], [1.0; 3], 0.1)?, 0.1)?;
    print("slope 5 × 10 × 15 × 2", &slope(5.0, 10.0, 15.0, 2.0, 0.5)?, 0.5)?;
    print("ball, radius 1", &ball([0.0; 3], 1.0, 0.1)?, 0.1)
}
