//! How wide the kernels of the mesh generators are: `cargo run --release -p mpm-mesh --example kernel_width`.
//!
//! Prints, for kernels as wide as the longest edge of the mesh and as those around the particle, and for the latter with exact gradients, the second moments Σ w_i (x_i − x)_a² of the weights in size² per axis, and which quadratic
//! splines are on average as wide (Σ w r² = D h²/4) and as steep (Σ |∇w|² = D (11/20)^(D−1) / h²): their h, in sizes. Means over D + 2 points of every cell, its middle and one near each corner.

use std::error::Error;
use std::io::Write;

use mpm_mesh::generate::{
    EdgeTarget, Scatter, SizeField, cuboid, rectangle, rectangle_outline, scattered, triangle_lattice,
};
use mpm_mesh::{Gradient, KernelWidth, MeshBasis, SampleWeight, SimplexMesh};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

fn main() -> Result<(), Box<dyn Error>> {
    for size in [0.4, 0.2] {
        let target = EdgeTarget {
            length: size,
            angle: 0.0,
        };
        print("rectangle", size, &rectangle([0.0; 2], [16.0, 6.0], &target)?)?;
        print("random", size, &random(size)?)?;
        print("lattice", size, &triangle_lattice([0.0; 2], [16.0, 6.0], size)?)?;
    }
    for size in [0.4, 0.3, 0.2] {
        print("box", size, &cuboid([0.0; 3], [16.0, 6.0, 0.5], size)?)?;
    }
    Ok(())
}

/// A Delaunay mesh of random points.
fn random(size: f64) -> Result<SimplexMesh<2>, Box<dyn Error>> {
    let mut generator = ChaCha8Rng::seed_from_u64(1);
    let outline = rectangle_outline([0.0; 2], [16.0, 6.0])?;
    let scatter = Scatter { sweeps: 2, angle: 0.0 };
    let field = SizeField::new(size, Vec::new())?;
    Ok(scattered(&[outline], &field, scatter, &mut || generator.random())?)
}

fn print<const D: usize>(name: &str, size: f64, mesh: &SimplexMesh<D>) -> Result<(), Box<dyn Error>> {
    let longest = mesh.edge_lengths().longest / size;
    let mut output = std::io::stdout().lock();
    writeln!(output, "{name} of size {size}, longest edge {longest:.2}")?;
    let paper = (SampleWeight::Continuous, Gradient::Diffuse);
    for (width, (weight, gradient), called) in [
        (KernelWidth::LongestEdge, paper, "longest edge"),
        (KernelWidth::Local, paper, "local"),
        (
            KernelWidth::Local,
            (SampleWeight::Smooth, Gradient::Exact),
            "local, exact",
        ),
    ] {
        let basis = MeshBasis::new(mesh)?
            .with_kernel_width(width)
            .with_sample_weight(weight);
        let Means { moments, steepness } = means(&basis.with_gradient(gradient));
        let moments = moments.map(|moment| moment / (size * size));
        let wide = (4.0 * moments.iter().sum::<f64>() / D as f64).sqrt();
        let steep = (D as f64 * 0.55f64.powi(D as i32 - 1) / steepness).sqrt() / size;
        writeln!(
            output,
            "  {called:12}: moments {moments:.3?}, as wide as splines of h = {wide:.2}, as steep as of {steep:.2}"
        )?;
    }
    Ok(())
}

/// Means over points of the cells.
struct Means<const D: usize> {
    /// Σ w r_a².
    moments: [f64; D],
    /// Σ |g|².
    steepness: f64,
}

fn means<const D: usize>(basis: &MeshBasis<D>) -> Means<D> {
    let (mut moments, mut steepness, mut points) = ([0.0; D], 0.0, 0.0);
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
            for entry in basis.weights_from(cell, &x).iter().map(|weight| &weight.entry) {
                for a in 0..D {
                    moments[a] += entry.weight * entry.offset[a].powi(2);
                    steepness += entry.gradient[a].powi(2);
                }
            }
            points += 1.0;
        }
    }
    Means {
        moments: moments.map(|sum| sum / points),
        steepness: steepness / points,
    }
}
