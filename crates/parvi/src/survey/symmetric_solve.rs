//! Linear equations whose size is known at run time only.

/// The solution of A x = b for a symmetric positive definite A, given by rows, of which the lower triangle is read; by Cholesky's
/// factorisation in place. `None` where A is not positive definite to rounding.
pub(super) fn solve(a: &mut [Vec<f64>], b: &[f64]) -> Option<Vec<f64>> {
    let n = b.len();
    for i in 0..n {
        for k in 0..=i {
            let inner: f64 = (0..k).map(|j| a[i][j] * a[k][j]).sum();
            let rest = a[i][k] - inner;
            if k < i {
                a[i][k] = rest / a[k][k];
            } else if rest > 0.0 && rest.is_finite() {
                a[i][i] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    let mut x = b.to_vec();
    for i in 0..n {
        let inner: f64 = (0..i).map(|j| a[i][j] * x[j]).sum();
        x[i] = (x[i] - inner) / a[i][i];
    }
    for i in (0..n).rev() {
        let inner: f64 = (i + 1..n).map(|j| a[j][i] * x[j]).sum();
        x[i] = (x[i] - inner) / a[i][i];
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_was_made_from_and_refuses_what_is_not_definite() {
        let a = [[4.0, 1.0, -2.0], [1.0, 3.0, 0.5], [-2.0, 0.5, 5.0]];
        let x = [1.0, -2.0, 3.0];
        let b: Vec<f64> = a
            .iter()
            .map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum())
            .collect();
        let mut rows: Vec<Vec<f64>> = a.iter().map(|row| row.to_vec()).collect();
        let found = solve(&mut rows, &b).unwrap();
        assert!(found.iter().zip(x).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
        assert!(solve(&mut [vec![1.0, 2.0], vec![2.0, 1.0]], &[1.0, 1.0]).is_none());
    }
}
