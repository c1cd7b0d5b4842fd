#![doc = include_str!("../README.md")]

mod adjacency;
mod boundary;
mod edge_lengths;
mod error;
mod mesh;
mod quality;
mod rings;

pub use adjacency::Lists;
pub use boundary::BoundaryFacet;
pub use edge_lengths::EdgeLengths;
pub use error::MeshError;
pub use mesh::{Frame, NO_CELL, SimplexMesh};
pub use quality::{Quality, QualitySummary};
pub use rings::Rings;
