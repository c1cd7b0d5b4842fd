use mpm_dense::DenseMatrix;

use crate::{distance, sample};

/// Σ_k A_ik B_kj.
fn naive(a: &DenseMatrix, b: &DenseMatrix) -> DenseMatrix {
    DenseMatrix::from_fn(a.rows(), b.columns(), |i, j| {
        (0..a.columns()).map(|k| a[(i, k)] * b[(k, j)]).sum()
    })
}

fn transposed(a: &DenseMatrix) -> DenseMatrix {
    DenseMatrix::from_fn(a.columns(), a.rows(), |i, j| a[(j, i)])
}

#[test]
fn products_are_sums() {
    for (m, n, p) in [(1, 1, 1), (3, 5, 2), (40, 7, 33), (90, 110, 70)] {
        let (a, b) = (sample(m, n), sample(n, p));
        let expected = naive(&a, &b);
        assert!(distance(&(&a * &b), &expected) < 1e-12);
        assert!(distance(&transposed(&a).transposed_times(&b), &expected) < 1e-12);
        assert!(distance(&a.times_transposed(&transposed(&b)), &expected) < 1e-12);
        let before = sample(n, n);
        let mut square = before.clone();
        square.add_square_of(&a);
        let whole = naive(&transposed(&a), &a);
        let expected = DenseMatrix::from_fn(n, n, |i, j| before[(i, j)] + whole[(i, j)]);
        assert!(distance(&square, &expected) < 1e-12);
    }
}

#[test]
fn entries_are_in_the_order_of_columns() {
    let mut matrix = DenseMatrix::from_fn(2, 3, |i, j| (10 * i + j) as f64);
    let expected = [0.0, 10.0, 1.0, 11.0, 2.0, 12.0];
    assert!(matrix.entries().copied().eq(expected) && matrix.column(1) == [1.0, 11.0]);
    matrix.entries_mut().for_each(|entry| *entry += 1.0);
    assert!(matrix.entries().copied().eq(expected.map(|entry| entry + 1.0)));
}
