//! Few coordinates, sums over many points.

mod gauss_newton;
mod linear;
