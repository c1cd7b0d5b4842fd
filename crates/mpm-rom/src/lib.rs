#![doc = include_str!("../README.md")]

mod activation;
pub mod deformation_map;
pub mod encoder;
pub mod experiment;
pub mod full_order;
pub mod least_squares;
pub mod manifold;
pub mod model;
mod nearest;
pub mod online;
pub mod position_error;
mod product;
pub mod snapshots;
pub mod tensor_file;
pub mod training;
mod words;
