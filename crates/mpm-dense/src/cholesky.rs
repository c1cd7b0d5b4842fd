use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::{factor, solve};
use faer::{Mat, Par};

use crate::DenseMatrix;

/// A = L Lᵀ, L lower triangular with a positive diagonal; on one thread, so that the bits do not hang on the number of threads.
#[derive(Clone, Debug, PartialEq)]
pub struct Cholesky {
    /// L at and below the diagonal.
    factor: Mat<f64>,
}

impl Cholesky {
    /// The factor of a symmetric matrix, of which only what is at and below the diagonal is read; `None` where it is not positive definite.
    pub fn new(matrix: &DenseMatrix) -> Option<Self> {
        let (mut lower, size) = (matrix.0.clone(), matrix.rows());
        let scratch = factor::cholesky_in_place_scratch::<f64>(size, Par::Seq, Default::default());
        let mut scratch = MemBuffer::new(scratch);
        let (stack, parameters) = (MemStack::new(&mut scratch), Default::default());
        factor::cholesky_in_place(lower.as_mut(), Default::default(), Par::Seq, stack, parameters).ok()?;
        (0..size)
            .all(|k| lower[(k, k)].is_finite())
            .then_some(Self { factor: lower })
    }

    /// L_ij for j ≤ i.
    #[inline]
    pub fn lower(&self, i: usize, j: usize) -> f64 {
        self.factor[(i, j)]
    }

    /// A⁻¹ b.
    ///
    /// # Panics
    /// Where b has not as many numbers as A has rows.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let size = self.factor.nrows();
        assert_eq!(right.len(), size, "numbers on the right-hand side, and rows");
        let mut solution = Mat::from_fn(size, 1, |i, _| right[i]);
        let mut scratch = MemBuffer::new(solve::solve_in_place_scratch::<f64>(size, 1, Par::Seq));
        let stack = MemStack::new(&mut scratch);
        solve::solve_in_place(self.factor.as_ref(), solution.as_mut(), Par::Seq, stack);
        solution.col_as_slice(0).to_vec()
    }
}
