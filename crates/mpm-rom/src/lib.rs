#![doc = include_str!("../README.md")]

pub mod deformation_map;
pub mod full_order;
pub mod least_squares;
pub mod manifold;
pub mod online;
pub mod position_error;
pub mod snapshots;
pub mod tensor_file;
