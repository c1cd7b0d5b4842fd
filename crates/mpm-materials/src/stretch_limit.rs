//! A guard: principal stretches that rounding can still tell from zero.

use mpm_tensor::{Matrix, SingularValues};

/// F with its stretches within [1/k, k]; F itself where they are, or where it is not finite.
pub(crate) fn limited<const D: usize>(F: &Matrix<D>, limit: f64) -> Matrix<D> {
    // No stretch is above |F|, and the product of all but the least is at most |F|^(D−1).
    let (norm, J) = (F.frobenius_norm(), F.determinant());
    if norm <= limit && J > 0.0 && J * limit >= norm.powi(D as i32 - 1) {
        return *F;
    }
    let Some(SingularValues { left, values, right }) = SingularValues::new(F) else {
        return *F;
    };
    let turned = D > 0 && left.determinant() * right.determinant() < 0.0;
    if !turned && values.iter().all(|&stretch| stretch <= limit && stretch * limit >= 1.0) {
        return *F;
    }
    let mut left = left;
    if turned {
        for row in &mut left.0 {
            row[D - 1] = -row[D - 1];
        }
    }
    let mut stretches = values;
    if turned {
        stretches[D - 1] = -stretches[D - 1];
    }
    let stretches = stretches.map(|stretch| stretch.clamp(limit.recip(), limit));
    left * Matrix::diagonal(&stretches) * right.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_within_the_limits_stays_to_the_bit() {
        for F in [
            Matrix([[1.0, 0.3], [-0.2, 0.5]]),
            Matrix([[9.0, 0.0], [0.0, 0.11]]),
            Matrix([[0.2, 0.0], [0.0, 0.2]]),
        ] {
            assert_eq!(limited(&F, 10.0), F);
        }
        let broken = Matrix([[f64::NAN, 0.0], [0.0, 1.0]]);
        assert!(limited(&broken, 10.0).0[0][0].is_nan());
    }

    #[test]
    fn stretches_end_at_the_limits_and_keep_their_axes() {
        let (c, s) = (0.6, 0.8);
        let (U, V) = (Matrix([[c, -s], [s, c]]), Matrix([[s, c], [-c, s]]));
        let of = |a: f64, b: f64| U * Matrix::diagonal(&[a, b]) * V.transpose();
        for (given, expected) in [
            ([100.0, 2.0], [10.0, 2.0]),
            ([5.0, 0.01], [5.0, 0.1]),
            ([100.0, 1e-30], [10.0, 0.1]),
            ([5.0, -0.5], [5.0, 0.1]),
            ([1e9, 1e9], [10.0, 10.0]),
            ([0.0, 0.0], [0.1, 0.1]),
        ] {
            let F = limited(&of(given[0], given[1]), 10.0);
            assert!(F.determinant() > 0.0, "{given:?}");
            let values = SingularValues::new(&F).expect("finite").values;
            assert!((values[0] - expected[0]).abs() < 1e-12 && (values[1] - expected[1]).abs() < 1e-12);
            if given != [0.0, 0.0] {
                let difference = F - of(expected[0], expected[1]);
                assert!(difference.frobenius_norm() < 1e-12, "{given:?}");
            }
        }
        let inverted = limited(&Matrix([[-3.0]]), 10.0);
        assert_eq!(inverted, Matrix([[0.1]]));
    }
}
