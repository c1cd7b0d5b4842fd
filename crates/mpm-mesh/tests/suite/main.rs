//! Meshes, and the material point method on them. One theme per file.

mod basis;
mod basis_scenes;
mod exact;
mod graded;
mod hat;
mod kernel;
mod kernel_closed_form;
mod kernel_polynomial;
mod mesh;
mod positive;
mod recovery;
mod search;
mod step;
