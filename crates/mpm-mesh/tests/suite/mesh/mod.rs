//! Meshes: what is refused, what is generated, read and written.

mod ampersand;
mod conformance;
mod figures;
mod gmsh_damage;
mod gmsh_files;
mod gmsh_groups;
mod layers;
mod mirror_layer;
mod parameters;
mod random;
mod refused;
mod rings;
mod samples;
mod scattered;
mod triangle_lattice;
mod vtu;
