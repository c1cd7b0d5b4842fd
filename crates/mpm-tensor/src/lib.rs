#![doc = include_str!("../README.md")]

mod matrix;
mod matrix_operators;
pub mod vector;

mod cholesky;
mod determinant;
mod in_dimensions;
mod inverse;
mod orthogonal;
mod polar;
mod singular_values;
mod symmetric_eigen;

mod lower_upper;
mod plane_rotation;
mod scaling;

pub use cholesky::{Cholesky, NotPositiveDefinite};
pub use matrix::Matrix;
pub use polar::Polar;
pub use scaling::power_of_two;
pub use singular_values::SingularValues;
pub use symmetric_eigen::SymmetricEigen;
