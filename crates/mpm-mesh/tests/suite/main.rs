//! Meshes, and the material point method on them. One theme per file.

mod basis;
#[path = "../../../mpm-core/tests/suite/basis_layout.rs"]
mod basis_layout;
mod basis_scenes;
#[path = "../../../mpm-core/tests/suite/basis_transfers.rs"]
mod basis_transfers;
mod graded;
mod hat;
mod kernel;
mod kernel_closed_form;
mod kernel_polynomial;
mod mesh;
mod recovery;
mod search;
mod step;
