//! Meshes: what is refused, what is generated, read and written.

mod conformance;
mod figures;
mod gmsh_damage;
mod gmsh_files;
mod layers;
mod parameters;
mod random;
mod refused;
mod rings;
mod samples;
mod scattered;
mod vtu;
