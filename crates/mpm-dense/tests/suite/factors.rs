use mpm_dense::{Cholesky, DenseMatrix, SingularValues, SymmetricEigen};

use crate::{distance, positive_definite, sample};

/// A diag(values).
fn scaled(a: &DenseMatrix, values: &[f64]) -> DenseMatrix {
    DenseMatrix::from_fn(a.rows(), a.columns(), |i, j| a[(i, j)] * values[j])
}

fn is_orthonormal(a: &DenseMatrix) -> bool {
    distance(&a.transposed_times(a), &DenseMatrix::identity(a.columns())) < 1e-13
}

#[test]
fn a_cholesky_factor_is_a_root_and_solves() {
    for size in [1, 4, 40] {
        let matrix = positive_definite(size);
        let factor = Cholesky::new(&matrix).expect("positive definite");
        let lower = DenseMatrix::from_fn(size, size, |i, j| if j <= i { factor.lower(i, j) } else { 0.0 });
        assert!(distance(&lower.times_transposed(&lower), &matrix) < 1e-12);
        let expected = sample(size, 1);
        let found = factor.solve((&matrix * &expected).column(0));
        assert!(found.iter().zip(expected.column(0)).all(|(a, b)| (a - b).abs() < 1e-10));
    }
    let indefinite = DenseMatrix::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 2.0 });
    assert!(Cholesky::new(&indefinite).is_none());
}

#[test]
fn eigenvectors_and_eigenvalues_make_the_matrix() {
    for size in [1, 5, 60] {
        let matrix = positive_definite(size);
        let SymmetricEigen { values, vectors } = SymmetricEigen::new(&matrix).expect("finite");
        assert!(values.is_sorted() && is_orthonormal(&vectors));
        assert!(distance(&scaled(&vectors, &values).times_transposed(&vectors), &matrix) < 1e-11);
    }
}

#[test]
fn singular_vectors_and_singular_values_make_the_matrix() {
    for (rows, columns) in [(1, 1), (30, 4), (4, 30), (200, 50)] {
        let matrix = sample(rows, columns);
        let SingularValues { left, values, right } = SingularValues::new(&matrix).expect("finite");
        assert_eq!(values.len(), rows.min(columns));
        assert!(values.is_sorted_by(|a, b| a >= b) && is_orthonormal(&left) && is_orthonormal(&right));
        assert!(distance(&scaled(&left, &values).times_transposed(&right), &matrix) < 1e-11);
    }
}

#[test]
fn orthonormal_columns_span_the_same() {
    let matrix = sample(30, 6);
    let basis = matrix.orthonormal_columns();
    assert!(basis.columns() == 6 && is_orthonormal(&basis));
    assert!(distance(&(&basis * &basis.transposed_times(&matrix)), &matrix) < 1e-12);
}

#[test]
fn an_inverse_is_one_and_a_determinant_that_of_the_factor() {
    let matrix = positive_definite(6);
    assert!(distance(&(&matrix * &matrix.inverse()), &DenseMatrix::identity(6)) < 1e-10);
    let factor = Cholesky::new(&matrix).expect("positive definite");
    let expected: f64 = (0..6).map(|k| factor.lower(k, k).powi(2)).product();
    assert!((matrix.determinant() / expected - 1.0).abs() < 1e-12);
    assert!(!DenseMatrix::zeros(2, 2).inverse()[(0, 0)].is_finite());
}

#[test]
fn a_matrix_without_entries_has_no_eigenvalues() {
    let nothing = DenseMatrix::zeros(0, 0);
    assert!(SymmetricEigen::new(&nothing).is_some_and(|eigen| eigen.values.is_empty()));
    assert!(SingularValues::new(&nothing).is_some_and(|found| found.values.is_empty()));
    assert!(Cholesky::new(&nothing).is_some_and(|factor| factor.solve(&[]).is_empty()));
}

#[test]
#[should_panic(expected = "right-hand side")]
fn a_right_hand_side_of_another_size_is_a_mistake() {
    Cholesky::new(&DenseMatrix::identity(2)).map(|factor| factor.solve(&[3.0, 3.0, 5.0]));
}

#[test]
fn what_is_not_finite_has_no_factors() {
    let matrix = DenseMatrix::from_fn(3, 3, |_, _| f64::NAN);
    assert!(Cholesky::new(&matrix).is_none() && SymmetricEigen::new(&matrix).is_none());
    assert!(SingularValues::new(&matrix).is_none());
}
