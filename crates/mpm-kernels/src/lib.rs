#![doc = include_str!("../README.md")]

mod axis_group;
mod columns;
mod deformed;
mod deposit;
mod gimp;
mod lanes;
mod layout;
mod packed;
mod quadratic_cube;
mod simplex;
mod simplex_point;
mod spline;
mod stencil;
mod stencil_deposit;
mod stencil_interpolate;
mod walk;

pub use columns::Columns;
pub use deformed::deformed;
pub use deposit::Deposit;
pub use gimp::Gimp;
pub use lanes::{LANES, Lanes, groups};
pub use layout::Layout;
pub use packed::{NodeField, NodeSink, Packed, groups_of};
pub use quadratic_cube::QuadraticCube;
pub use simplex::{LARGEST_LATTICE_DIMENSION, SimplexGeometry};
pub use simplex_point::SimplexPoint;
pub use spline::{Cubic, Linear, Quadratic, Row, Rows, SecondMoment, Spline};
pub use stencil::{Entry, Stencil, UniformGrid};
pub use stencil_interpolate::{Interpolated, Wanted};
