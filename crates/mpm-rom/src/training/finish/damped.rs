//! Inverses of damped matrices.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::{factor, inverse, solve};
use faer::{Mat, MatMut, MatRef, Par};

/// The factor of A + λ diag A.
pub(crate) struct Damped {
    factor: Mat<f64>,
    scratch: MemBuffer,
}

impl Damped {
    /// `matrix` is symmetric with a diagonal ≥ 0; entries of it below 10⁻⁹ of the largest are raised to that. `None` where the sum is not positive definite in floating-point numbers.
    pub fn new(matrix: &[f64], size: usize, damping: f64) -> Option<Self> {
        let mut sum = MatRef::from_row_major_slice(matrix, size, size).to_owned();
        let largest = (0..size).map(|k| matrix[k * size + k]).fold(0.0, f64::max);
        for k in 0..size {
            sum[(k, k)] += damping * sum[(k, k)].max(1e-9 * largest);
        }
        let factoring = factor::cholesky_in_place_scratch::<f64>(size, Par::Seq, Default::default());
        let inverting = inverse::inverse_scratch::<f64>(size, Par::Seq);
        let solving = solve::solve_in_place_scratch::<f64>(size, 1, Par::Seq);
        let mut scratch = MemBuffer::new(factoring.or(inverting).or(solving));
        let stack = MemStack::new(&mut scratch);
        factor::cholesky_in_place(sum.as_mut(), Default::default(), Par::Seq, stack, Default::default()).ok()?;
        Some(Self { factor: sum, scratch })
    }

    /// (A + λ diag A)⁻¹ x.
    pub fn solve(&mut self, x: &[f64]) -> Vec<f64> {
        let mut solution = x.to_vec();
        let right = MatMut::from_column_major_slice_mut(&mut solution, x.len(), 1);
        let stack = MemStack::new(&mut self.scratch);
        solve::solve_in_place(self.factor.as_ref(), right, Par::Seq, stack);
        solution
    }

    /// (A + λ diag A)⁻¹, row-major.
    pub fn inverse(&mut self) -> Vec<f64> {
        let size = self.factor.nrows();
        let mut out = Mat::zeros(size, size);
        let stack = MemStack::new(&mut self.scratch);
        inverse::inverse(out.as_mut(), self.factor.as_ref(), Par::Seq, stack);
        // Only its lower half is written.
        let entry = |k: usize| out[((k / size).max(k % size), (k / size).min(k % size))];
        (0..size * size).map(entry).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_with_the_damped_matrix_give_back_what_was_solved_for() {
        let size = 7;
        let factor: Vec<f64> = (0..size * size).map(|k| (1.3 * k as f64).sin()).collect();
        let entry = |i: usize, j: usize| {
            (0..size)
                .map(|k| factor[i * size + k] * factor[j * size + k])
                .sum::<f64>()
        };
        let matrix: Vec<f64> = (0..size * size).map(|k| entry(k / size, k % size)).collect();
        let x: Vec<f64> = (0..size).map(|k| (k as f64).cos()).collect();
        let mut damped = Damped::new(&matrix, size, 0.1).expect("positive definite");
        let solution = damped.solve(&x);
        let inverse = damped.inverse();
        for i in 0..size {
            let mut product: f64 = (0..size).map(|j| matrix[i * size + j] * solution[j]).sum();
            product += 0.1 * matrix[i * size + i] * solution[i];
            assert!((product - x[i]).abs() < 1e-12);
            let by_inverse: f64 = (0..size).map(|j| inverse[i * size + j] * x[j]).sum();
            assert!((by_inverse - solution[i]).abs() < 1e-11);
        }
        assert!(Damped::new(&[1.0, 2.0, 2.0, 1.0], 2, 0.1).is_none());
    }
}
