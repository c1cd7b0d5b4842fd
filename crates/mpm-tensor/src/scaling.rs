//! Scaling by powers of two, which is exact.

use crate::Matrix;

/// The power of two 2^−e for which the largest entry of 2^−e A lies in [1, 2); entries in the subnormal range are
/// brought as close to it as a finite factor can. 1 for the zero matrix, `None` if an entry is not finite.
#[inline]
pub(crate) fn reciprocal_scale<const D: usize>(matrix: &Matrix<D>) -> Option<f64> {
    const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
    let largest = matrix.maximum_norm();
    if !largest.is_finite() {
        return None;
    }
    if largest == 0.0 {
        return Some(1.0);
    }
    let power = f64::from_bits(largest.to_bits() & EXPONENT_BITS);
    Some(1.0 / power.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_brought_to_order_one() {
        for size in [1.0, 3.0, 1e-300, 1e300, f64::MAX, f64::MIN_POSITIVE, 1e-310] {
            let matrix = Matrix([[0.0, -size], [size / 2.0, 0.0]]);
            let scaled = (matrix * reciprocal_scale(&matrix).expect("finite entries")).maximum_norm();
            assert!(
                scaled < 2.0 && (scaled >= 1.0 || size < f64::MIN_POSITIVE),
                "{size}: {scaled}"
            );
        }
        assert_eq!(reciprocal_scale(&Matrix::<3>::ZERO), Some(1.0));
        assert_eq!(reciprocal_scale(&Matrix([[f64::NAN]])), None);
        assert_eq!(reciprocal_scale(&Matrix([[f64::NEG_INFINITY]])), None);
    }
}
