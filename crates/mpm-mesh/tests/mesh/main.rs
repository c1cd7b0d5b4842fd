//! Meshes: what is refused, what is generated, read and written.

mod conformance;
mod figures;
mod refused;
mod rings;
mod samples;
