use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::qr::no_pivoting::{factor, solve};
use faer::{Mat, Par};

use crate::DenseMatrix;

/// min_w |A w − b|² by Householder QR, on one thread. The storage is kept from one problem to the next of the same size: [`shape`](Self::shape), fill
/// [`matrix`](Self::matrix) and [`right`](Self::right), [`factorise`](Self::factorise), look at the [`pivots`](Self::pivots), [`solve`](Self::solve).
pub struct LeastSquares {
    /// A, which becomes R and the reflections of Q.
    pub matrix: DenseMatrix,
    /// b, one column, which becomes w and what is left of the equations.
    pub right: DenseMatrix,
    coefficients: Mat<f64>,
    scratch: MemBuffer,
}

impl Default for LeastSquares {
    fn default() -> Self {
        Self {
            matrix: DenseMatrix::zeros(0, 0),
            right: DenseMatrix::zeros(0, 1),
            coefficients: Mat::new(),
            scratch: MemBuffer::new(StackReq::EMPTY),
        }
    }
}

impl LeastSquares {
    /// Storage for problems of so many equations and unknowns, which are not more.
    pub fn shape(&mut self, equations: usize, unknowns: usize) {
        if (self.matrix.rows(), self.matrix.columns()) == (equations, unknowns) {
            return;
        }
        let block = factor::recommended_block_size::<f64>(equations, unknowns);
        let factoring = factor::qr_in_place_scratch::<f64>(equations, unknowns, block, Par::Seq, Default::default());
        let solving = solve::solve_lstsq_in_place_scratch::<f64>(equations, unknowns, block, 1, Par::Seq);
        self.matrix = DenseMatrix::zeros(equations, unknowns);
        self.coefficients = Mat::zeros(block, unknowns);
        self.right = DenseMatrix::zeros(equations, 1);
        self.scratch = MemBuffer::new(factoring.or(solving));
    }

    /// A = Q R in the place of A.
    pub fn factorise(&mut self) {
        let (matrix, coefficients) = (self.matrix.0.as_mut(), self.coefficients.as_mut());
        let stack = MemStack::new(&mut self.scratch);
        factor::qr_in_place(matrix, coefficients, Par::Seq, stack, Default::default());
    }

    /// |R_kk|: zero, to rounding, where column k depends on those before it.
    pub fn pivots(&self) -> impl Iterator<Item = f64> + Clone {
        (0..self.matrix.columns()).map(|k| self.matrix[(k, k)].abs())
    }

    /// w = R⁻¹ Qᵀ b of the factorised matrix, in the place of b.
    pub fn solve(&mut self) -> &[f64] {
        let (factors, coefficients) = (self.matrix.0.as_ref(), self.coefficients.as_ref());
        let stack = MemStack::new(&mut self.scratch);
        solve::solve_lstsq_in_place(factors, coefficients, factors, self.right.0.as_mut(), Par::Seq, stack);
        &self.right.column(0)[..self.matrix.columns()]
    }
}
