use faer::Side;

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
    /// That of a symmetric matrix, of which only what is at and below the diagonal is read; `None` where the iteration does not converge and where entries are not finite.
    pub fn new(matrix: &DenseMatrix) -> Option<Self> {
        if matrix.rows() == 0 {
            return Some(Self {
                values: Vec::new(),
                vectors: DenseMatrix::zeros(0, 0),
            });
        }
        let found = matrix.0.self_adjoint_eigen(Side::Lower).ok()?;
        let values: Vec<f64> = found.S().column_vector().iter().copied().collect();
        let vectors = DenseMatrix(found.U().to_owned());
        values
            .iter()
            .all(|value| value.is_finite())
            .then_some(Self { values, vectors })
    }
}
