//! The reduced-order model, from the outside. One theme per file.

mod common;
mod experiment;
mod full_order;
mod least_squares;
mod linear;
mod snapshots;
mod tensor_file;
mod training;
