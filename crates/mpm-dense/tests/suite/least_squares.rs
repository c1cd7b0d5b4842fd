use mpm_dense::{DenseMatrix, LeastSquares};

use crate::sample;

#[test]
fn what_is_left_is_orthogonal_to_the_columns() {
    let mut problem = LeastSquares::default();
    for (equations, unknowns) in [(3, 1), (40, 6), (6, 6), (40, 6)] {
        let (matrix, right) = (sample(equations, unknowns), sample(equations, 1));
        problem.shape(equations, unknowns);
        for i in 0..equations {
            problem.right[(i, 0)] = right[(i, 0)];
            (0..unknowns).for_each(|k| problem.matrix[(i, k)] = matrix[(i, k)]);
        }
        problem.factorise();
        assert!(problem.pivots().count() == unknowns && problem.pivots().all(|pivot| pivot > 0.01));
        let found = problem.solve().to_vec();
        let fitted = &matrix * &DenseMatrix::from_fn(unknowns, 1, |k, _| found[k]);
        let left = DenseMatrix::from_fn(equations, 1, |i, _| right[(i, 0)] - fitted[(i, 0)]);
        assert!(
            matrix
                .transposed_times(&left)
                .entries()
                .all(|slope| slope.abs() < 1e-12)
        );
    }
}

#[test]
fn a_column_that_hangs_on_those_before_it_has_no_pivot() {
    let mut problem = LeastSquares::default();
    problem.shape(5, 2);
    for i in 0..5 {
        problem.matrix[(i, 0)] = i as f64 - 1.0;
        problem.matrix[(i, 1)] = 3.0 - 3.0 * i as f64;
    }
    problem.factorise();
    let pivots: Vec<f64> = problem.pivots().collect();
    assert!(pivots[0] > 1.0 && pivots[1] < 1e-14, "{pivots:?}");
}
