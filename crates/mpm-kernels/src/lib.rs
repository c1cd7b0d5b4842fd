#![doc = include_str!("../README.md")]

mod deposit;
mod lanes;
mod simplex;
mod simplex_point;
mod spline;
mod stencil;

pub use deposit::Deposit;
pub use lanes::{LANES, Lanes, groups};
pub use simplex::{LARGEST_LATTICE_DIMENSION, SimplexGeometry};
pub use simplex_point::SimplexPoint;
pub use spline::{Cubic, Linear, Quadratic, Row, Spline};
pub use stencil::{Entry, Stencil, UniformGrid};
