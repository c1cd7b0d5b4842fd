//! Vectors and matrices. One theme per file.

#[macro_use]
mod common;

mod algebra;
mod decompositions;
mod hostile_input;
