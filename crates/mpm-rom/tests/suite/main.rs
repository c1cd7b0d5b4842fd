//! The reduced-order model, from the outside. One theme per file.

mod common;
mod experiment;
mod linear;
mod training;
