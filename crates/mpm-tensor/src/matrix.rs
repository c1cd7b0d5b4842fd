//! The square matrix type, its constructors and the products that yield scalars or transposes.

use crate::vector;

/// A D × D matrix of `f64`, row-major: `matrix.0[row][column]`.
///
/// It stands for second-order tensors (deformation gradients, stresses, covariances) and for linear maps of `[f64; D]`.
/// No operation panics for rows and columns within D; NaN and infinite entries follow IEEE 754 unless stated otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix<const D: usize>(pub [[f64; D]; D]);

impl<const D: usize> Matrix<D> {
    /// The zero matrix.
    pub const ZERO: Self = Self([[0.0; D]; D]);

    /// The identity matrix I, I_ij = δ_ij.
    pub const IDENTITY: Self = {
        let mut rows = [[0.0; D]; D];
        let mut i = 0;
        while i < D {
            rows[i][i] = 1.0;
            i += 1;
        }
        Self(rows)
    };

    /// The matrix with entries A_ij = `entry(i, j)`, called row by row.
    #[inline]
    pub fn from_fn(mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let mut rows = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                rows[i][j] = entry(i, j);
            }
        }
        Self(rows)
    }

    /// The diagonal matrix diag(d), A_ij = d_i δ_ij.
    #[inline]
    pub fn diagonal(entries: &[f64; D]) -> Self {
        let mut matrix = Self::ZERO;
        for i in 0..D {
            matrix.0[i][i] = entries[i];
        }
        matrix
    }

    /// The outer product a bᵀ, A_ij = a_i b_j.
    #[inline]
    pub fn outer(a: &[f64; D], b: &[f64; D]) -> Self {
        Self::from_fn(|i, j| a[i] * b[j])
    }

    /// The column with the given index; `None` if it is D or more.
    #[inline]
    pub fn column(&self, column: usize) -> Option<[f64; D]> {
        (column < D).then(|| std::array::from_fn(|row| self.0[row][column]))
    }

    /// The transpose Aᵀ, (Aᵀ)_ij = A_ji.
    #[inline]
    pub fn transpose(&self) -> Self {
        Self::from_fn(|i, j| self.0[j][i])
    }

    /// The symmetric part ½ (A + Aᵀ).
    ///
    /// Exactly symmetric. Each half is taken before the sum, so finite entries cannot overflow.
    #[inline]
    pub fn symmetric_part(&self) -> Self {
        Self::from_fn(|i, j| 0.5 * self.0[i][j] + 0.5 * self.0[j][i])
    }

    /// The trace tr A = Σ_i A_ii.
    #[inline]
    pub fn trace(&self) -> f64 {
        let mut sum = 0.0;
        for i in 0..D {
            sum += self.0[i][i];
        }
        sum
    }

    /// The double contraction A : B = Σ_ij A_ij B_ij = tr(Aᵀ B).
    #[inline]
    pub fn contract(&self, other: &Self) -> f64 {
        let mut sum = 0.0;
        for i in 0..D {
            sum += vector::dot(&self.0[i], &other.0[i]);
        }
        sum
    }

    /// The Frobenius norm ‖A‖ = √(A : A), in the range stated at [`vector::norm`].
    #[inline]
    pub fn frobenius_norm(&self) -> f64 {
        self.contract(self).sqrt()
    }

    /// The largest entry in absolute value, max_ij |A_ij|; zero for D = 0, NaN if an entry is NaN.
    #[inline]
    pub fn maximum_norm(&self) -> f64 {
        let mut sizes = [0.0; D];
        for i in 0..D {
            sizes[i] = vector::maximum_norm(&self.0[i]);
        }
        vector::maximum_norm(&sizes)
    }

    /// The matrix-vector product A x; `matrix * x` is the same.
    #[inline]
    pub fn apply(&self, x: &[f64; D]) -> [f64; D] {
        let mut product = [0.0; D];
        for i in 0..D {
            product[i] = vector::dot(&self.0[i], x);
        }
        product
    }

    /// The product with the transpose, Aᵀ x, without forming it.
    #[inline]
    pub fn apply_transposed(&self, x: &[f64; D]) -> [f64; D] {
        let mut product = [0.0; D];
        for i in 0..D {
            vector::accumulate(&mut product, x[i], &self.0[i]);
        }
        product
    }

    /// Whether every entry is finite (neither NaN nor infinite).
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(vector::is_finite)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Matrix<2> = Matrix([[1.0, 2.0], [3.0, 5.0]]);

    #[test]
    fn constructors_place_their_entries() {
        assert_eq!(Matrix::<2>::IDENTITY, Matrix([[1.0, 0.0], [0.0, 1.0]]));
        assert_eq!(Matrix::diagonal(&[2.0, 3.0]), Matrix([[2.0, 0.0], [0.0, 3.0]]));
        assert_eq!(
            Matrix::outer(&[1.0, 2.0], &[3.0, 4.0]),
            Matrix([[3.0, 4.0], [6.0, 8.0]])
        );
        assert_eq!(
            Matrix::from_fn(|i, j| (2 * i + j) as f64),
            Matrix([[0.0, 1.0], [2.0, 3.0]])
        );
    }

    #[test]
    fn scalars_and_transposes_follow_their_formulas() {
        assert_eq!(A.column(1), Some([2.0, 5.0]));
        assert_eq!(A.column(2), None);
        assert_eq!(A.transpose(), Matrix([[1.0, 3.0], [2.0, 5.0]]));
        assert_eq!(A.symmetric_part(), Matrix([[1.0, 2.5], [2.5, 5.0]]));
        assert_eq!(A.trace(), 6.0);
        assert_eq!(A.contract(&Matrix([[1.0, -1.0], [0.5, 2.0]])), 10.5);
        assert_eq!(A.frobenius_norm(), 39f64.sqrt());
        assert_eq!(A.maximum_norm(), 5.0);
    }

    #[test]
    fn products_with_vectors_follow_their_formulas() {
        assert_eq!(A.apply(&[1.0, 2.0]), [5.0, 13.0]);
        assert_eq!(A.apply_transposed(&[1.0, 2.0]), [7.0, 12.0]);
    }

    #[test]
    fn not_a_number_is_seen() {
        let bad = Matrix([[1.0, f64::NAN], [3.0, 4.0]]);
        assert!(bad.maximum_norm().is_nan());
        assert!(!bad.is_finite());
        assert!(A.is_finite());
    }
}
