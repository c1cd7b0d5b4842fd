//! Meshes: what is refused, what is generated, read and written.

mod conformance;
mod figures;
mod layers;
mod parameters;
mod random;
mod refused;
mod rings;
mod samples;
