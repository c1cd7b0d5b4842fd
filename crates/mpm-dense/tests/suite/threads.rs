use mpm_dense::{DenseMatrix, SingularValues, SymmetricEigen};

use crate::{positive_definite, sample};

/// What `compute` makes on one, two and four threads is the same.
fn same_bits(what: &str, compute: impl Fn() -> Vec<DenseMatrix> + Sync) {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(&compute)
    };
    let one = on(1);
    assert!([2, 4].into_iter().all(|threads| on(threads) == one), "{what}");
}

#[test]
fn factors_do_not_hang_on_the_number_of_threads() {
    for (rows, columns) in [(240, 124), (124, 240), (900, 60)] {
        let matrix = sample(rows, columns);
        same_bits(&format!("singular values of {rows} x {columns}"), || {
            let found = SingularValues::new(&matrix).expect("finite");
            let values = DenseMatrix::from_fn(found.values.len(), 1, |i, _| found.values[i]);
            vec![found.left, values, found.right]
        });
        same_bits(&format!("orthonormal columns of {rows} x {columns}"), || {
            vec![matrix.orthonormal_columns()]
        });
    }
    for size in [30, 100, 300] {
        let matrix = positive_definite(size);
        same_bits(&format!("eigenvalues of {size}"), || {
            let found = SymmetricEigen::new(&matrix).expect("finite");
            let values = DenseMatrix::from_fn(size, 1, |i, _| found.values[i]);
            vec![values, found.vectors]
        });
        same_bits(&format!("orthonormal columns of {size}"), || {
            vec![matrix.orthonormal_columns()]
        });
        same_bits(&format!("inverse of {size}"), || vec![matrix.inverse()]);
        same_bits(&format!("determinant of {size}"), || {
            vec![DenseMatrix::from_fn(1, 1, |_, _| matrix.determinant())]
        });
    }
}

#[test]
fn products_do_not_hang_on_the_number_of_threads() {
    for (m, n, p) in [
        (40, 40, 40),
        (90, 110, 70),
        (300, 300, 300),
        (20, 5000, 20),
        (7, 3000, 500),
    ] {
        let (a, b) = (sample(m, n), sample(n, p));
        same_bits(&format!("product of {m} x {n} x {p}"), || vec![&a * &b]);
        same_bits(&format!("square of {n} x {m}"), || vec![a.times_transposed(&a)]);
        same_bits(&format!("square of {m} x {n}"), || vec![a.transposed_times(&a)]);
    }
}
