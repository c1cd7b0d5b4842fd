//! From the coordinates of a correlation block to a matrix.

use mpm_tensor::Matrix;

use super::partial_correlations::{entries_below_diagonal, entries_of_triangle};
use crate::TargetError;

/// The symmetric K × K matrix of unit diagonal whose entries below the diagonal are `entries`, row by row: what a
/// [`correlation`](crate::ConstraintsBuilder::correlation) block holds.
///
/// # Errors
/// [`TargetError::Length`] unless there are K(K−1)/2 entries.
///
/// ```
/// let matrix = parvi_targets::correlation_matrix::<3>(&[0.1, 0.2, 0.3])?;
/// assert_eq!(matrix.0, [[1.0, 0.1, 0.2], [0.1, 1.0, 0.3], [0.2, 0.3, 1.0]]);
/// # Ok::<(), parvi_targets::TargetError>(())
/// ```
pub fn correlation_matrix<const K: usize>(entries: &[f64]) -> Result<Matrix<K>, TargetError> {
    check(entries, entries_below_diagonal(K), "the list of correlations")?;
    let mut matrix = Matrix::IDENTITY;
    let mut entries = entries.iter();
    for i in 0..K {
        for (j, &entry) in (0..i).zip(&mut entries) {
            matrix.0[i][j] = entry;
            matrix.0[j][i] = entry;
        }
    }
    Ok(matrix)
}

/// The lower triangular K × K matrix whose entries, diagonal included, are `entries`, row by row: what a
/// [`correlation_cholesky`](crate::ConstraintsBuilder::correlation_cholesky) block holds.
///
/// # Errors
/// [`TargetError::Length`] unless there are K(K+1)/2 entries.
///
/// ```
/// let factor = parvi_targets::lower_triangle::<2>(&[1.0, 0.6, 0.8])?;
/// assert_eq!(factor.0, [[1.0, 0.0], [0.6, 0.8]]);
/// # Ok::<(), parvi_targets::TargetError>(())
/// ```
pub fn lower_triangle<const K: usize>(entries: &[f64]) -> Result<Matrix<K>, TargetError> {
    check(entries, entries_of_triangle(K), "the list of entries of the triangle")?;
    let mut matrix = Matrix::ZERO;
    let mut entries = entries.iter();
    for i in 0..K {
        for (j, &entry) in (0..=i).zip(&mut entries) {
            matrix.0[i][j] = entry;
        }
    }
    Ok(matrix)
}

fn check(entries: &[f64], expected: usize, field: &str) -> Result<(), TargetError> {
    if entries.len() == expected {
        Ok(())
    } else {
        Err(TargetError::Length {
            field: field.to_owned(),
            expected,
            found: entries.len(),
        })
    }
}
