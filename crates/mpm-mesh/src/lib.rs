#![doc = include_str!("../README.md")]

mod adjacency;
mod basis;
mod boundary;
mod edge_lengths;
mod error;
pub mod generate;
mod gmsh;
mod hat;
mod jitter;
mod kernel;
mod mesh;
mod quality;
mod recovery;
mod rings;
mod search;
mod vtu;

pub use adjacency::Lists;
pub use basis::{Gradient, KernelWidth, MeshBasis, Outside, WeightAt};
pub use boundary::BoundaryFacet;
pub use edge_lengths::EdgeLengths;
pub use error::MeshError;
pub use gmsh::{MshError, MshFormat, NamedMesh, Place, read_msh, read_named_msh, write_msh};
pub use hat::HatBasis;
pub use kernel::SampleWeight;
pub use mesh::{Frame, NO_CELL, SimplexMesh};
pub use quality::{Quality, QualitySummary};
pub use recovery::recovered;
pub use rings::Rings;
pub use search::{CellSearch, Located, NearestPoint};
pub use vtu::{Field, VtuError, mesh_vtu};
