use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::svd::{ComputeSvdVectors, svd, svd_scratch};
use faer::{Mat, Par};

use crate::DenseMatrix;

/// A = U Σ Vᵀ, thin: as many singular values as A has rows or columns, whichever are fewer.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularValues {
    /// U, orthonormal columns.
    pub left: DenseMatrix,
    /// Σ_kk ≥ 0, descending.
    pub values: Vec<f64>,
    /// V, orthonormal columns.
    pub right: DenseMatrix,
}

impl SingularValues {
    /// `None` where the iteration does not converge and where entries are not finite. On one thread: with more, sums are taken in another order, and the bits would hang on their number.
    pub fn new(matrix: &DenseMatrix) -> Option<Self> {
        let (rows, columns) = (matrix.rows(), matrix.columns());
        let size = rows.min(columns);
        let (mut left, mut right) = (Mat::zeros(rows, size), Mat::zeros(columns, size));
        let mut values = Diag::zeros(size);
        let thin = ComputeSvdVectors::Thin;
        let scratch = svd_scratch::<f64>(rows, columns, thin, thin, Par::Seq, Default::default());
        svd(
            matrix.0.as_ref(),
            values.as_mut(),
            Some(left.as_mut()),
            Some(right.as_mut()),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            Default::default(),
        )
        .ok()?;
        let values: Vec<f64> = values.column_vector().iter().copied().collect();
        values.iter().all(|value| value.is_finite()).then_some(Self {
            left: DenseMatrix(left),
            right: DenseMatrix(right),
            values,
        })
    }
}
