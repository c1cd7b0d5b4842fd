//! Vectors and matrices. One theme per file.

mod algebra;
mod common;
mod decompositions;
mod hostile_input;
