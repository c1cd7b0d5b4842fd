#![doc = include_str!("../README.md")]
//!
//! ## Where to begin
//!
//! With [`Outcome`], what a run gave in a form without a dimension, and [`ParticleFile`], which takes its [`Particles`]. [`FrameWriter`] and [`pictures::History`] are observers of a run; [`pictures::Subject`]
//! draws what these and the outcome hold. Other files are written by [`AtomicFile`]. All errors are a [`FileError`].

mod atomic_file;
mod directory;
mod distinct_names;
mod error;
mod frames;
#[cfg(feature = "npy")]
mod npy;
#[cfg(not(feature = "npy"))]
#[path = "npy_left_out.rs"]
mod npy;
mod number_table;
mod outcome;
mod particle_file;
mod particles;
pub mod particles_csv;
mod particles_npy;
pub mod pictures;
pub mod table_file;

pub use atomic_file::AtomicFile;
pub use directory::OutputDirectory;
pub use distinct_names::distinct_names;
pub use error::FileError;
pub use frames::FrameWriter;
pub use number_table::NumberTable;
pub use outcome::{Outcome, SurveyPoint, Watched};
pub use particle_file::{ParticleFile, ParticleFormat, npy_is_built};
pub use particles::Particles;
