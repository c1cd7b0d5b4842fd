#![doc = include_str!("../README.md")]

mod cholesky;
mod least_squares;
mod lu;
mod matrix;
mod product;
mod singular_values;
mod symmetric_eigen;

pub use cholesky::Cholesky;
pub use least_squares::LeastSquares;
pub use matrix::DenseMatrix;
pub use singular_values::SingularValues;
pub use symmetric_eigen::SymmetricEigen;
