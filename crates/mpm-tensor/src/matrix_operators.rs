//! The arithmetic operators of [`Matrix`].

use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::{Matrix, vector};

impl<const D: usize> Add for Matrix<D> {
    type Output = Self;

    /// The sum A + B.
    #[inline]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const D: usize> AddAssign for Matrix<D> {
    /// A ← A + B.
    #[inline]
    fn add_assign(&mut self, other: Self) {
        for i in 0..D {
            self.0[i] = vector::add(&self.0[i], &other.0[i]);
        }
    }
}

impl<const D: usize> Sub for Matrix<D> {
    type Output = Self;

    /// The difference A − B.
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<const D: usize> SubAssign for Matrix<D> {
    /// A ← A − B.
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        for i in 0..D {
            self.0[i] = vector::subtract(&self.0[i], &other.0[i]);
        }
    }
}

impl<const D: usize> Neg for Matrix<D> {
    type Output = Self;

    /// The negative −A.
    #[inline]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const D: usize> Mul<f64> for Matrix<D> {
    type Output = Self;

    /// The multiple s A.
    #[inline]
    fn mul(mut self, factor: f64) -> Self {
        self *= factor;
        self
    }
}

impl<const D: usize> Mul<Matrix<D>> for f64 {
    type Output = Matrix<D>;

    /// The multiple s A.
    #[inline]
    fn mul(self, matrix: Matrix<D>) -> Matrix<D> {
        matrix * self
    }
}

impl<const D: usize> MulAssign<f64> for Matrix<D> {
    /// A ← s A.
    #[inline]
    fn mul_assign(&mut self, factor: f64) {
        for row in &mut self.0 {
            *row = vector::scale(row, factor);
        }
    }
}

impl<const D: usize> Mul for Matrix<D> {
    type Output = Self;

    /// The product A B, (A B)_ij = Σ_k A_ik B_kj, summed in the order of k.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let mut product = Self::ZERO;
        for i in 0..D {
            for k in 0..D {
                vector::accumulate(&mut product.0[i], self.0[i][k], &other.0[k]);
            }
        }
        product
    }
}

impl<const D: usize> Mul<[f64; D]> for Matrix<D> {
    type Output = [f64; D];

    /// The matrix-vector product A x.
    #[inline]
    fn mul(self, x: [f64; D]) -> [f64; D] {
        self.apply(&x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_follow_their_formulas() {
        let a = Matrix([[1.0, 2.0], [3.0, 4.0]]);
        let b = Matrix([[0.0, 1.0], [-1.0, 2.0]]);
        assert_eq!(a + b, Matrix([[1.0, 3.0], [2.0, 6.0]]));
        assert_eq!(a - b, Matrix([[1.0, 1.0], [4.0, 2.0]]));
        assert_eq!(-a, Matrix([[-1.0, -2.0], [-3.0, -4.0]]));
        assert_eq!(a * 2.0, 2.0 * a);
        assert_eq!(a * 2.0, a + a);
        assert_eq!(a * b, Matrix([[-2.0, 5.0], [-4.0, 11.0]]));
        assert_eq!(a * [1.0, 2.0], [5.0, 11.0]);
    }
}
