//! Rotations, scales and shifts.

use mpm_tensor::{Matrix, vector};

use crate::error::finite;
use crate::{Bijection, TargetError};

/// x = c + A y, log|det J| = log|det A|.
#[derive(Clone, Debug, PartialEq)]
pub struct Affine<const D: usize> {
    shift: [f64; D],
    matrix: Matrix<D>,
    inverse: Matrix<D>,
    log_determinant: f64,
}

impl<const D: usize> Affine<D> {
    /// The map of the shift c and the matrix A.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`] for an entry, or for log|det A| where A is singular.
    pub fn new(shift: [f64; D], matrix: Matrix<D>) -> Result<Self, TargetError> {
        let entries = shift.iter().chain(matrix.0.iter().flatten());
        for &entry in entries {
            finite("an entry of an affine map", entry)?;
        }
        let field = "the logarithm of the determinant of an affine map";
        let log_determinant = finite(field, matrix.determinant().abs().ln())?;
        let inverse = matrix.inverse().ok_or_else(|| TargetError::NotFinite {
            field: "the inverse of an affine map".to_owned(),
            value: f64::INFINITY,
        })?;
        Ok(Self {
            shift,
            matrix,
            inverse,
            log_determinant,
        })
    }

    /// x_k = c_k + s_k y_k.
    ///
    /// # Errors
    /// As [`new`](Self::new), also for a scale of zero.
    pub fn scales(shift: [f64; D], scales: [f64; D]) -> Result<Self, TargetError> {
        Self::new(shift, Matrix::diagonal(&scales))
    }
}

impl<const D: usize> Bijection<D> for Affine<D> {
    fn forward(&self, y: &[f64; D]) -> [f64; D] {
        vector::add(&self.shift, &self.matrix.apply(y))
    }

    fn inverse(&self, x: &[f64; D]) -> [f64; D] {
        self.inverse.apply(&vector::subtract(x, &self.shift))
    }

    fn log_determinant(&self, _y: &[f64; D]) -> f64 {
        self.log_determinant
    }

    fn push_gradient(&self, _y: &[f64; D], gradient: &[f64; D]) -> [f64; D] {
        self.inverse.apply_transposed(gradient)
    }
}
