//! Splines, stencils and lattices. One theme per file.

mod kernels;
mod lattice;
mod transfers;
