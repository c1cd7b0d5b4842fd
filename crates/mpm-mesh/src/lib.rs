#![doc = include_str!("../README.md")]

mod adjacency;
mod appended;
mod boundary;
mod edge_lengths;
mod error;
pub mod generate;
mod gmsh;
mod mesh;
mod quality;
mod rings;
mod vtu;

pub use adjacency::Lists;
pub use boundary::BoundaryFacet;
pub use edge_lengths::EdgeLengths;
pub use error::MeshError;
pub use gmsh::{MshError, MshFormat, Place, read_msh, write_msh};
pub use mesh::{Frame, NO_CELL, SimplexMesh};
pub use quality::{Quality, QualitySummary};
pub use rings::Rings;
pub use vtu::{Field, VtuError, mesh_vtu};
