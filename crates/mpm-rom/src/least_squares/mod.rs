//! Small dense least squares: few coordinates, many points.

mod gauss_newton;
mod linear;
mod non_negative;

pub(crate) use gauss_newton::squared_distance;
pub use gauss_newton::{GaussNewton, Settings};
pub use linear::{LeastSquares, LeastSquaresError};
pub(crate) use non_negative::NonNegative;
