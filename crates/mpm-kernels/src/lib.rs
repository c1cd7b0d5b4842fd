#![doc = include_str!("../README.md")]

mod axis_group;
mod cell_stencil;
mod columns;
mod deformed;
mod deposit;
mod gimp;
mod lanes;
mod packed;
mod simplex;
mod simplex_point;
mod spline;
mod stencil;
mod stencil_deposit;
mod stencil_interpolate;
mod walk;

pub use cell_stencil::{CellLanes, CellStencil, differences};
pub use columns::Columns;
pub use deformed::deformed;
pub use deposit::Deposit;
pub use gimp::Gimp;
pub use lanes::{LANES, Lanes, groups};
pub use packed::{NodeField, NodeSink, Packed, groups_of};
pub use simplex::{LARGEST_LATTICE_DIMENSION, SimplexGeometry};
pub use simplex_point::SimplexPoint;
pub use spline::{Cubic, Linear, Quadratic, Row, Rows, SecondMoment, Spline};
pub use stencil::{Entry, Stencil, UniformGrid};
pub use stencil_interpolate::{Interpolated, Wanted};
