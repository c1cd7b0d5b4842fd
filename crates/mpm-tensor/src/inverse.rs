//! The inverse of a general matrix.

use crate::Matrix;
use crate::lower_upper::LowerUpper;
use crate::scaling::reciprocal_scale;

impl<const D: usize> Matrix<D> {
    /// The inverse A⁻¹: closed form (adjugate over determinant) for D ≤ 2, elimination with partial pivoting above.
    ///
    /// The relative error is a small multiple of 2⁻⁵³ σ_max / σ_min. `None` if an entry is not finite, if a pivot or the
    /// determinant is zero, or if the inverse overflows. A matrix that is singular only up to rounding yields a huge
    /// inverse.
    #[inline]
    pub fn inverse(&self) -> Option<Self> {
        // Entries of order one: their products neither overflow nor underflow to zero.
        let factor = reciprocal_scale(self)?;
        let scaled = *self * factor;
        let inverse = match D {
            0..=2 => scaled.closed_inverse(),
            _ => LowerUpper::new(&scaled).inverse(),
        };
        let inverse = inverse * factor;
        inverse.is_finite().then_some(inverse)
    }

    /// adj A / det A for D ≤ 2; not finite where the determinant is zero.
    #[inline]
    fn closed_inverse(&self) -> Self {
        let determinant = self.determinant();
        Self::from_fn(|i, j| {
            let adjugate = match D {
                1 => 1.0,
                _ if i == j => self.0[1 - i][1 - j],
                _ => -self.0[i][j],
            };
            adjugate / determinant
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_inverses() {
        assert_eq!(Matrix([[4.0]]).inverse(), Some(Matrix([[0.25]])));
        assert_eq!(
            Matrix([[1.0, 2.0], [3.0, 4.0]]).inverse(),
            Some(Matrix([[-2.0, 1.0], [1.5, -0.5]]))
        );
        let upper = Matrix([[1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 2.0]]);
        assert_eq!(
            upper.inverse(),
            Some(Matrix([[1.0, -1.0, 0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 0.5]]))
        );
        assert_eq!(Matrix::<6>::IDENTITY.inverse(), Some(Matrix::IDENTITY));
    }

    #[test]
    fn singular_and_non_finite_matrices_have_none() {
        assert_eq!(Matrix::<1>::ZERO.inverse(), None);
        assert_eq!(Matrix([[1.0, 2.0], [2.0, 4.0]]).inverse(), None);
        assert_eq!(Matrix::<3>::ZERO.inverse(), None);
        assert_eq!(Matrix::<5>::from_fn(|i, j| (i * j) as f64).inverse(), None);
        assert_eq!(Matrix([[f64::NAN, 0.0], [0.0, 1.0]]).inverse(), None);
        assert_eq!(Matrix::<4>::diagonal(&[1.0, f64::INFINITY, 1.0, 1.0]).inverse(), None);
    }

    #[test]
    fn tiny_and_huge_scales_are_inverted() {
        for scale in [1e-200, 1e200] {
            let inverse = (Matrix::<3>::IDENTITY * scale)
                .inverse()
                .expect("a multiple of the identity");
            assert!((inverse * scale - Matrix::IDENTITY).frobenius_norm() < 1e-15);
        }
    }
}
