//! The determinant.

use crate::Matrix;
use crate::lower_upper::LowerUpper;

impl<const D: usize> Matrix<D> {
    /// The determinant det A: closed form for D ≤ 3, elimination with partial pivoting above; 1 for D = 0.
    ///
    /// The absolute error is a small multiple of 2⁻⁵² Π_i ‖row i‖. NaN if an entry is NaN; an infinite entry gives NaN
    /// or an infinity.
    #[inline]
    pub fn determinant(&self) -> f64 {
        let a = &self.0;
        match D {
            0 => 1.0,
            1 => a[0][0],
            2 => a[0][0] * a[1][1] - a[0][1] * a[1][0],
            3 => {
                a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1])
                    + a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2])
                    + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0])
            }
            _ if self.is_finite() => LowerUpper::new(self).determinant(),
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_forms_and_elimination_agree_with_known_values() {
        assert_eq!(Matrix::<0>([]).determinant(), 1.0);
        assert_eq!(Matrix([[-3.0]]).determinant(), -3.0);
        assert_eq!(Matrix([[1.0, 2.0], [3.0, 4.0]]).determinant(), -2.0);
        assert_eq!(
            Matrix([[0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [5.0, 0.0, 0.0]]).determinant(),
            30.0
        );
        assert_eq!(
            Matrix([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]).determinant(),
            0.0
        );
        let swap = Matrix([
            [0.0, 1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 2.0, 0.0],
            [0.0, 0.0, 0.0, 3.0],
        ]);
        assert_eq!(swap.determinant(), -6.0);
        assert_eq!(Matrix::<5>::ZERO.determinant(), 0.0);
    }
}
