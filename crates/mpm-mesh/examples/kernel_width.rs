//! How wide the kernels of the mesh generators are: `cargo run --release -p mpm-mesh --example kernel_width`.
//!
//! Prints the second moments Σ w_i (x_i − x)_a² of the weights, in size², per axis and as their mean, and the longest edge in sizes; means over
//! D + 2 points of every cell, its middle and one near each corner. Quadratic splines on a grid have 0.25.

use std::error::Error;
use std::io::Write;

use mpm_mesh::generate::{EdgeTarget, cuboid, rectangle, triangle_lattice};
use mpm_mesh::{MeshBasis, SimplexMesh};

fn main() -> Result<(), Box<dyn Error>> {
    for size in [0.4, 0.2] {
        let target = EdgeTarget {
            length: size,
            angle: 0.0,
        };
        print("rectangle", size, &rectangle([0.0; 2], [16.0, 6.0], &target)?)?;
        print("lattice", size, &triangle_lattice([0.0; 2], [16.0, 6.0], size)?)?;
    }
    for size in [0.4, 0.3, 0.2] {
        print("box", size, &cuboid([0.0; 3], [16.0, 6.0, 0.5], size)?)?;
    }
    Ok(())
}

fn print<const D: usize>(name: &str, size: f64, mesh: &SimplexMesh<D>) -> Result<(), Box<dyn Error>> {
    let moments = second_moments(mesh)?.map(|moment| moment / (size * size));
    let mean = moments.iter().sum::<f64>() / D as f64;
    let longest = mesh.edge_lengths().longest / size;
    let mut output = std::io::stdout().lock();
    writeln!(
        output,
        "{name:9} size {size}: moments {moments:.3?}, mean {mean:.3}, longest edge {longest:.2}"
    )?;
    Ok(())
}

/// Mean over points of the cells.
fn second_moments<const D: usize>(mesh: &SimplexMesh<D>) -> Result<[f64; D], Box<dyn Error>> {
    let basis = MeshBasis::new(mesh)?;
    let (mut sums, mut points) = ([0.0; D], 0.0);
    for cell in 0..basis.mesh().cell_count() as u32 {
        let corners = basis.mesh().cell(cell as usize);
        // Near no corner in the last turn: the middle.
        for nearest in 0..=D + 1 {
            let share = |n: usize| match nearest {
                _ if nearest > D => 1.0,
                _ if n == nearest => 2.0,
                _ => 0.5,
            };
            let total: f64 = (0..=D).map(share).sum();
            let x: [f64; D] = std::array::from_fn(|a| {
                let coordinates = (0..=D).map(|n| share(n) * basis.mesh().vertices()[corners[n] as usize][a]);
                coordinates.sum::<f64>() / total
            });
            for weight in basis.weights_from(cell, &x) {
                let vertex = basis.mesh().vertices()[weight.vertex as usize];
                for a in 0..D {
                    sums[a] += weight.entry.weight * (vertex[a] - x[a]).powi(2);
                }
            }
            points += 1.0;
        }
    }
    Ok(sums.map(|sum| sum / points))
}
