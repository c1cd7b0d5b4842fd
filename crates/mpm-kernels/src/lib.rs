#![doc = include_str!("../README.md")]

mod spline;
mod stencil;

pub use spline::{Cubic, Linear, Quadratic, Row, Spline};
pub use stencil::{Entry, Stencil, UniformGrid};
