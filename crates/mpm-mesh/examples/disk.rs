//! Writes a mesh of the unit disk: `cargo run -p mpm-mesh --example disk -- 0.12 experiments/meshes/disk.msh`.

use std::error::Error;

use mpm_mesh::generate::{EdgeTarget, disk};
use mpm_mesh::{MshFormat, write_msh};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [length, file] = &arguments[..] else {
        return Err("two arguments: the length of edges and a file".into());
    };
    let target = EdgeTarget {
        length: length.parse()?,
        angle: 0.0,
    };
    let mesh = disk([0.0; 2], 1.0, &target)?;
    std::fs::write(file, write_msh(&mesh, MshFormat::Text41))?;
    Ok(())
}
