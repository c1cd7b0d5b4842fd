use std::ops::Mul;

use faer::linalg::matmul::matmul;
use faer::{Accum, MatRef, Par, get_global_parallelism};

use crate::DenseMatrix;

impl DenseMatrix {
    /// Aᵀ B.
    pub fn transposed_times(&self, other: &Self) -> Self {
        product(self.0.transpose(), other.0.as_ref())
    }

    /// A Bᵀ.
    pub fn times_transposed(&self, other: &Self) -> Self {
        product(self.0.as_ref(), other.0.transpose())
    }

    /// Adds Aᵀ A, on one thread: the bits do not hang on the number of threads, however many the rows of A are.
    pub fn add_square_of(&mut self, other: &Self) {
        let (left, right) = (other.0.transpose(), other.0.as_ref());
        matmul(self.0.as_mut(), Accum::Add, left, right, 1.0, Par::Seq);
    }
}

/// A B.
impl Mul for &DenseMatrix {
    type Output = DenseMatrix;

    fn mul(self, other: Self) -> DenseMatrix {
        product(self.0.as_ref(), other.0.as_ref())
    }
}

fn product(left: MatRef<f64>, right: MatRef<f64>) -> DenseMatrix {
    let mut product = DenseMatrix::zeros(left.nrows(), right.ncols());
    matmul(
        product.0.as_mut(),
        Accum::Replace,
        left,
        right,
        1.0,
        get_global_parallelism(),
    );
    product
}
