#![doc = include_str!("../README.md")]

mod matrix;
mod matrix_operators;
pub mod vector;

mod determinant;
mod inverse;
mod lower_upper;

pub use matrix::Matrix;
