//! Products, factorisations and least squares against their definitions.

mod factors;
mod least_squares;
mod products;
mod threads;

use mpm_dense::DenseMatrix;

/// Entries of both signs without a pattern.
fn sample(rows: usize, columns: usize) -> DenseMatrix {
    DenseMatrix::from_fn(rows, columns, |i, j| {
        (1.0 + (17 * i + 5 * j) as f64 + (i * j) as f64).sin()
    })
}

/// AᵀA + I.
fn positive_definite(size: usize) -> DenseMatrix {
    let mut matrix = DenseMatrix::identity(size);
    matrix.add_square_of(&sample(size, size));
    matrix
}

/// The largest difference of two entries.
fn distance(a: &DenseMatrix, b: &DenseMatrix) -> f64 {
    assert_eq!((a.rows(), a.columns()), (b.rows(), b.columns()));
    a.entries()
        .zip(b.entries())
        .fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}
