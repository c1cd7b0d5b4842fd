#![doc = include_str!("../README.md")]

mod activation;
pub mod encoder;
pub mod manifold;
pub mod model;
mod product;
pub mod snapshots;
pub mod tensor_file;
pub mod training;
