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
    /// `None` where the iteration does not converge and where entries are not finite.
    pub fn new(matrix: &DenseMatrix) -> Option<Self> {
        let found = matrix.0.thin_svd().ok()?;
        let values: Vec<f64> = found.S().column_vector().iter().copied().collect();
        values.iter().all(|value| value.is_finite()).then(|| Self {
            left: DenseMatrix(found.U().to_owned()),
            right: DenseMatrix(found.V().to_owned()),
            values,
        })
    }
}
