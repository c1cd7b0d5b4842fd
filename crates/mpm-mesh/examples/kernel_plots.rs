//! Weights and diffuse gradients, with and without η, on graded segments and on a mesh of an "&": `cargo run -p mpm-mesh --example kernel_plots -- DIRECTORY`.
//!
//! * `graded_1.1.csv` to `graded_1.5.csv`: cells of sizes 1, R, R², R in turn; columns x, node (5 to 8, from 0 on), weight, gradient, `weight_distance_alone`,
//!   `gradient_distance_alone`; 200 points per cell, where a cell ends one from either side of the node, so that jumps are upright lines;
//! * `ampersand.vtu`: the mesh;
//! * `ampersand.csv`: one node at a re-entrant corner; columns x, y, cell, weight, `gradient_x`, `gradient_y` and the same for distances alone, at the points of every cell with
//!   barycentric coordinates k / 12, so points of a face come twice, from either side.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use mpm_mesh::generate::{EdgeTarget, ampersand, segments};
use mpm_mesh::{MeshBasis, SampleWeight, SimplexMesh, mesh_vtu};

/// Points per cell, D = 1.
const POINTS: u32 = 200;

/// Parts that edges are divided into, D = 2.
const DIVISIONS: usize = 12;

/// With η and without.
const BOTH: [SampleWeight; 2] = [SampleWeight::Continuous, SampleWeight::DistanceAlone];

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).ok_or("usage: kernel_plots DIRECTORY")?);
    std::fs::create_dir_all(&directory)?;
    for ratio in [1.1, 1.2, 1.3, 1.4, 1.5] {
        std::fs::write(directory.join(format!("graded_{ratio}.csv")), graded(ratio)?)?;
    }
    plane(&directory)
}

fn bases<const D: usize>(mesh: &SimplexMesh<D>) -> Result<Vec<MeshBasis<D>>, Box<dyn Error>> {
    let basis = MeshBasis::new(mesh)?;
    Ok(BOTH.map(|weight| basis.clone().with_sample_weight(weight)).to_vec())
}

/// Weight and gradient at `x` of the vertex `node` of the mesh that was given, from the side of `cell`.
fn entry<const D: usize>(basis: &MeshBasis<D>, cell: u32, x: &[f64; D], node: u32) -> (f64, [f64; D]) {
    let weights = basis.weights_from(cell, x);
    let found = weights.iter().find(|weight| basis.given_vertex(weight.vertex) == node);
    found.map_or((0.0, [0.0; D]), |weight| (weight.entry.weight, weight.entry.gradient))
}

fn graded(ratio: f64) -> Result<String, Box<dyn Error>> {
    let pattern = [1.0, ratio, ratio * ratio, ratio];
    let sizes: Vec<f64> = pattern.into_iter().cycle().take(14).collect();
    let mesh = segments(0.0, &sizes)?;
    let bases = bases(&mesh)?;
    let mut text = String::from("x,node,weight,gradient,weight_distance_alone,gradient_distance_alone\n");
    let mut cells: Vec<u32> = (0..mesh.cell_count() as u32).collect();
    cells.sort_by_key(|&cell| bases[0].given_cell(cell));
    for node in 5..=8 {
        for &cell in &cells {
            let [start, end] =
                [0, 1].map(|n| bases[0].mesh().vertices()[bases[0].mesh().cell(cell as usize)[n] as usize][0]);
            for k in 0..=POINTS {
                let x = start + (end - start) * f64::from(k) / f64::from(POINTS);
                write!(text, "{x},{node}")?;
                for basis in &bases {
                    let (weight, [gradient]) = entry(basis, cell, &[x], node);
                    write!(text, ",{weight},{gradient}")?;
                }
                text.push('\n');
            }
        }
    }
    Ok(text)
}

fn plane(directory: &Path) -> Result<(), Box<dyn Error>> {
    let target = EdgeTarget {
        length: 0.045,
        angle: 0.0,
    };
    let mesh = ampersand(1.0, &target)?;
    std::fs::write(directory.join("ampersand.vtu"), mesh_vtu(&mesh, &[], &[])?)?;
    let bases = bases(&mesh)?;
    // The corner between leg and arm.
    let corner = [0.66, 0.26];
    let away = |x: &[f64; 2]| (x[0] - corner[0]).hypot(x[1] - corner[1]);
    let vertices = mesh.vertices().iter().zip(0u32..);
    let (_, node) = vertices
        .min_by(|(a, _), (b, _)| away(a).total_cmp(&away(b)))
        .ok_or("a mesh without vertices")?;
    let mut text = String::from("x,y,cell,weight,gradient_x,gradient_y");
    text += ",weight_distance_alone,gradient_x_distance_alone,gradient_y_distance_alone\n";
    for (cell, members) in bases[0].mesh().cells().enumerate() {
        let corners = [0, 1, 2].map(|n| bases[0].mesh().vertices()[members[n] as usize]);
        let near = bases[0].weights_from(cell as u32, &corners[0]);
        if !near.iter().any(|weight| bases[0].given_vertex(weight.vertex) == node) {
            continue; // the node is not in the ring
        }
        for i in 0..=DIVISIONS {
            for j in 0..=DIVISIONS - i {
                let shares = [i, j, DIVISIONS - i - j].map(|k| k as f64 / DIVISIONS as f64);
                let x = [0, 1].map(|a| (0..3).map(|n| shares[n] * corners[n][a]).sum::<f64>());
                write!(text, "{},{},{}", x[0], x[1], bases[0].given_cell(cell as u32))?;
                for basis in &bases {
                    let (weight, [along_x, along_y]) = entry(basis, cell as u32, &x, node);
                    write!(text, ",{weight},{along_x},{along_y}")?;
                }
                text.push('\n');
            }
        }
    }
    std::fs::write(directory.join("ampersand.csv"), text)?;
    Ok(())
}
