#![doc = include_str!("../README.md")]

mod error;
mod mesh;

pub use error::MeshError;
pub use mesh::SimplexMesh;
