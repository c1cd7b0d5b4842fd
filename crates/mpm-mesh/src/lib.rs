#![doc = include_str!("../README.md")]

mod adjacency;
mod basis;
mod boundary;
mod edge_lengths;
mod error;
pub mod generate;
mod hat;
mod jitter;
mod kernel;
mod mesh;
mod quality;
mod rings;
mod search;

pub use adjacency::Lists;
pub use basis::{MeshBasis, Outside, WeightAt};
pub use boundary::BoundaryFacet;
pub use edge_lengths::EdgeLengths;
pub use error::MeshError;
pub use hat::HatBasis;
pub use kernel::SampleWeight;
pub use mesh::{Frame, NO_CELL, SimplexMesh};
pub use quality::{Quality, QualitySummary};
pub use rings::Rings;
pub use search::{CellSearch, Located, NearestPoint};
