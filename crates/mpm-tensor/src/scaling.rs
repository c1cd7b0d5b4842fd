//! Scaling by powers of two, which is exact.

use crate::Matrix;

/// The largest normal power of two up to |size|, a unit in which values keep their digits and their squares stay in range; 1 of zero and of what is not finite.
#[inline]
pub fn power_of_two(size: f64) -> f64 {
    const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
    if size == 0.0 || !size.is_finite() {
        return 1.0;
    }
    f64::from_bits(size.to_bits() & EXPONENT_BITS).max(f64::MIN_POSITIVE)
}

/// The power of two 2^−e for which the largest entry of 2^−e A lies in [1, 2); entries in the subnormal range are
/// brought as close to it as a finite factor can. 1 for the zero matrix, `None` if an entry is not finite.
#[inline]
pub(crate) fn reciprocal_scale<const D: usize>(matrix: &Matrix<D>) -> Option<f64> {
    let largest = matrix.maximum_norm();
    largest.is_finite().then(|| 1.0 / power_of_two(largest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_power_of_two_is_at_most_the_size() {
        for (size, power) in [
            (1.0, 1.0),
            (-3.9, 2.0),
            (f64::MAX, 2f64.powi(1023)),
            (1e-310, f64::MIN_POSITIVE),
            (0.0, 1.0),
            (f64::NAN, 1.0),
            (f64::INFINITY, 1.0),
        ] {
            assert_eq!(power_of_two(size), power, "{size}");
        }
    }

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
