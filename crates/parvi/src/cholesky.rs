//! Cholesky's factorisation of a matrix whose size is known at run time only.

/// L with A = L Lᵀ for a symmetric positive definite A.
#[derive(Clone, Debug)]
pub(crate) struct Cholesky {
    /// The lower triangle, a row after the other.
    rows: Vec<Vec<f64>>,
}

impl Cholesky {
    /// The factor of A, given by rows, of which the lower triangle is read; `None` where A is not positive definite to rounding.
    pub fn new(mut a: Vec<Vec<f64>>) -> Option<Self> {
        for i in 0..a.len() {
            let (above, row) = a.split_at_mut(i);
            let row = &mut row[0];
            for (k, other) in above.iter().enumerate() {
                row[k] = (row[k] - inner(&row[..k], &other[..k])) / other[k];
            }
            let rest = row[i] - inner(&row[..i], &row[..i]);
            if !(rest > 0.0 && rest.is_finite()) {
                return None;
            }
            row[i] = rest.sqrt();
        }
        Some(Self { rows: a })
    }

    /// The solution of A x = b.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = b.to_vec();
        for (i, row) in self.rows.iter().enumerate() {
            x[i] = (x[i] - inner(&row[..i], &x[..i])) / row[i];
        }
        for i in (0..x.len()).rev() {
            let inner: f64 = (i + 1..x.len()).map(|k| self.rows[k][i] * x[k]).sum();
            x[i] = (x[i] - inner) / self.rows[i][i];
        }
        x
    }
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
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
        let rows = a.iter().map(|row| row.to_vec()).collect();
        let found = Cholesky::new(rows).unwrap().solve(&b);
        assert!(found.iter().zip(x).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
        assert!(Cholesky::new(vec![vec![1.0, 2.0], vec![2.0, 1.0]]).is_none());
    }
}
