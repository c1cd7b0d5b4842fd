#![doc = include_str!("../README.md")]

pub mod manifold;
pub mod snapshots;
pub mod tensor_file;
