//! The exponential linear unit, ELU(z) = z for z > 0 and e^z − 1 otherwise.

use mpm_tensor::vector::multiply_add;

/// Below this 2ᵏ is no normal number; e^z − 1 is −1 long before.
const SMALLEST_ARGUMENT: f64 = -708.0;

/// Adding it to |y| < 2⁵¹ rounds y to an integer, which then stands in the lowest bits: 1.5 · 2⁵².
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// ln 2 in two parts; the upper one has 11 trailing zero bits, so that its product with an integer below 2¹¹ is exact.
const LOG_TWO_UPPER: f64 = f64::from_bits(0x3FE6_2E42_FEFA_3800);
const LOG_TWO_LOWER: f64 = 5.497_923_018_708_371e-14;

/// 1/n! for n = 12 … 2: Taylor's polynomial of eʳ, remainder below 2e-16 for |r| ≤ ½ ln 2.
const INVERSE_FACTORIALS: [f64; 11] = {
    let mut inverse = [1.0; 11];
    let mut n = 0;
    while n < 11 {
        let mut factorial = 1_u64;
        let mut k = 2;
        while k <= 12 - n as u64 {
            factorial *= k;
            k += 1;
        }
        inverse[n] = 1.0 / factorial as f64;
        n += 1;
    }
    inverse
};

/// (ELU(z), ELU'(z)) with ELU' = 1 for z > 0 and e^z otherwise; absolute error below 1e-15. NaN stays NaN in the value.
///
/// ELU'' = ELU' where ELU' < 1 and 0 elsewhere. Without branches, hence open to vectorisation.
#[inline(always)]
pub(crate) fn elu(z: f64) -> (f64, f64) {
    let (positive, negative) = if z > 0.0 { (z, 0.0) } else { (0.0, z) };
    let slope = exponential(negative);
    (positive + (slope - 1.0), slope)
}

/// e^z for z ≤ 0: z = k ln 2 + r, e^z = 2ᵏ eʳ.
#[inline(always)]
fn exponential(z: f64) -> f64 {
    let z = if z < SMALLEST_ARGUMENT { SMALLEST_ARGUMENT } else { z };
    let shifted = multiply_add(z, std::f64::consts::LOG2_E, ROUNDING);
    let k = shifted - ROUNDING;
    let r = multiply_add(k, -LOG_TWO_LOWER, multiply_add(k, -LOG_TWO_UPPER, z));
    let mut sum = 0.0;
    for inverse in INVERSE_FACTORIALS {
        sum = multiply_add(sum, r, inverse);
    }
    let power = multiply_add(r * r, sum, r) + 1.0;
    f64::from_bits(power.to_bits().wrapping_add(shifted.to_bits() << 52))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_and_slope_follow_the_formula() {
        for i in -2_000_000..=200_000 {
            let z = 2e-5 * f64::from(i);
            let (value, slope) = elu(z);
            let (expected, expected_slope) = if z > 0.0 { (z, 1.0) } else { (z.exp() - 1.0, z.exp()) };
            assert!(
                (value - expected).abs() < 1e-15 && (slope - expected_slope).abs() < 1e-15,
                "{z}"
            );
        }
        assert_eq!(elu(0.0), (0.0, 1.0));
        assert_eq!(elu(f64::INFINITY), (f64::INFINITY, 1.0));
        assert_eq!(elu(f64::NEG_INFINITY).0, -1.0);
        assert!(elu(f64::NAN).0.is_nan());
    }
}
