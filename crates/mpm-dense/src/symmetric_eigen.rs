use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Mat, Par};

use crate::DenseMatrix;

/// A = V Λ Vᵀ of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricEigen {
    /// Λ_kk, ascending.
    pub values: Vec<f64>,
    /// V, an eigenvector per column.
    pub vectors: DenseMatrix,
}

impl SymmetricEigen {
    /// That of a symmetric matrix, of which only what is at and below the diagonal is read; `None` where the iteration does not converge and where entries are not finite. On one thread, as singular values are.
    pub fn new(matrix: &DenseMatrix) -> Option<Self> {
        if matrix.rows() == 0 {
            return Some(Self {
                values: Vec::new(),
                vectors: DenseMatrix::zeros(0, 0),
            });
        }
        let size = matrix.rows();
        let (mut values, mut vectors) = (Diag::zeros(size), Mat::zeros(size, size));
        let scratch = self_adjoint_evd_scratch::<f64>(size, ComputeEigenvectors::Yes, Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        let (of, stack) = (matrix.0.as_ref(), MemStack::new(&mut memory));
        let found = Some(vectors.as_mut());
        self_adjoint_evd(of, values.as_mut(), found, Par::Seq, stack, Default::default()).ok()?;
        let values: Vec<f64> = values.column_vector().iter().copied().collect();
        values.iter().all(|value| value.is_finite()).then_some(Self {
            values,
            vectors: DenseMatrix(vectors),
        })
    }
}
