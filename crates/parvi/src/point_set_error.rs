//! What is wrong with a sample that is to be condensed into fewer points.

use parvi_targets::TargetError;

/// Why a sample cannot be condensed into fewer points.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointSetError {
    /// There is nothing to choose from or nothing to place.
    #[error("{field} is empty")]
    Empty {
        /// Which set.
        field: &'static str,
    },
    /// There must be one score per position.
    #[error("the number of scores is {scores}, that of positions {positions}")]
    LengthMismatch {
        /// Number of positions.
        positions: usize,
        /// Number of scores.
        scores: usize,
    },
    /// A number is NaN, infinite, or so large that its square is.
    #[error("{field} {index} is {value:?}: too large or not finite")]
    NotFinite {
        /// Which numbers.
        field: &'static str,
        /// Index of the point.
        index: usize,
        /// What was given.
        value: Vec<f64>,
    },
    /// The tolerance is no tolerance.
    #[error("tolerance = {value}: must be finite and at least 0")]
    Tolerance {
        /// What was given.
        value: f64,
    },
    /// The covariance of the positions cannot scale the kernel: they lie in a plane of fewer dimensions.
    #[error("the covariance of the positions cannot scale the kernel: {0}")]
    Covariance(TargetError),
}

/// An error that names the first point with a coordinate that is not finite, or too large to be squared and summed.
pub(crate) fn check_finite<const D: usize>(field: &'static str, points: &[[f64; D]]) -> Result<(), PointSetError> {
    const LARGEST: f64 = 1e140;
    match points.iter().position(|x| !x.iter().all(|c| c.abs() < LARGEST)) {
        None => Ok(()),
        Some(index) => Err(PointSetError::NotFinite {
            field,
            index,
            value: points[index].to_vec(),
        }),
    }
}
