//! Products of the small matrices in a network, all on one thread.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

/// Z = A Wᵀ for columns A (`columns` × `inputs`) and W (`outputs` × `inputs`, row-major); A and Z column-major.
pub(crate) fn forward(z: &mut [f64], a: &[f64], weights: &[f64], columns: usize, inputs: usize, outputs: usize) {
    let z = MatMut::from_column_major_slice_mut(z, columns, outputs);
    let a = MatRef::from_column_major_slice(a, columns, inputs);
    let weights = MatRef::from_row_major_slice(weights, outputs, inputs);
    matmul(z, Accum::Replace, a, weights.transpose(), 1.0, Par::Seq);
}

/// A̅ = Z̅ W, the adjoint of the columns.
pub(crate) fn columns_adjoint(
    a: &mut [f64],
    z: &[f64],
    weights: &[f64],
    columns: usize,
    inputs: usize,
    outputs: usize,
) {
    let a = MatMut::from_column_major_slice_mut(a, columns, inputs);
    let z = MatRef::from_column_major_slice(z, columns, outputs);
    let weights = MatRef::from_row_major_slice(weights, outputs, inputs);
    matmul(a, Accum::Replace, z, weights, 1.0, Par::Seq);
}

/// W̅ += Z̅ᵀ A, the adjoint of the weights.
pub(crate) fn weights_adjoint(
    weights: &mut [f64],
    z: &[f64],
    a: &[f64],
    columns: usize,
    inputs: usize,
    outputs: usize,
) {
    let weights = MatMut::from_row_major_slice_mut(weights, outputs, inputs);
    let z = MatRef::from_column_major_slice(z, columns, outputs);
    let a = MatRef::from_column_major_slice(a, columns, inputs);
    matmul(weights, Accum::Add, z.transpose(), a, 1.0, Par::Seq);
}
