use faer::linalg::solvers::Solve;

use crate::DenseMatrix;

impl DenseMatrix {
    /// A⁻¹ by elimination with row exchanges. Where A is singular entries are not finite, or, where rounding has left a pivot that should be zero, huge and without meaning.
    pub fn inverse(&self) -> Self {
        let identity = Self::identity(self.rows());
        Self(self.0.partial_piv_lu().solve(&identity.0))
    }

    /// det A, by elimination with row exchanges.
    pub fn determinant(&self) -> f64 {
        self.0.determinant()
    }
}
