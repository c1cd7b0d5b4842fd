//! An exponential that a compiler can vectorise, and the dispatch to the widest vector instructions of the machine.

/// Arguments beyond ± this value are clamped: e^±708 are the last powers of e whose reciprocal is a normal number.
const LARGEST_ARGUMENT: f64 = 708.0;

/// Adding it to |y| < 2⁵¹ rounds y to an integer, which then stands in the lowest bits: 1.5 · 2⁵².
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// ln 2 in two parts; the upper one has 11 trailing zero bits, so its product with |k| ≤ 1022 is exact
/// (W. J. Cody, W. Waite, *Software Manual for the Elementary Functions*, 1980).
const LOG_TWO_UPPER: f64 = f64::from_bits(0x3FE6_2E42_FEFA_3800);
const LOG_TWO_LOWER: f64 = 5.497_923_018_708_371e-14;

/// eᵗ for t in [−708, 708], clamped outside; relative error below 4e-16. NaN stays NaN.
///
/// Without branches and without table look-ups, hence open to vectorisation: t = k ln 2 + r with |r| ≤ ½ ln 2, eʳ by its
/// Taylor polynomial of degree 13 (remainder 4e-18), 2ᵏ through the exponent bits. IEEE 754 defines each operation, the
/// fused multiply-add included, so the bits are the same on every machine. Call it inside
/// [`with_widest_vectors`] only: compiled for a processor without a fused multiply-add, each becomes a slow call.
#[inline(always)]
pub(crate) fn exponential(t: f64) -> f64 {
    const C: [f64; 14] = inverse_factorials();
    let t = if t > LARGEST_ARGUMENT { LARGEST_ARGUMENT } else { t };
    let t = if t < -LARGEST_ARGUMENT { -LARGEST_ARGUMENT } else { t };
    let shifted = t.mul_add(std::f64::consts::LOG2_E, ROUNDING);
    let k = shifted - ROUNDING;
    let r = k.mul_add(-LOG_TWO_LOWER, k.mul_add(-LOG_TWO_UPPER, t));
    // Estrin's scheme on the terms from r² on: 1 + (r + r² q(r)) keeps the leading terms' rounding to the last sum.
    let (r2, r4) = (r * r, (r * r) * (r * r));
    let q0 = r2.mul_add(r.mul_add(C[5], C[4]), r.mul_add(C[3], C[2]));
    let q4 = r2.mul_add(r.mul_add(C[9], C[8]), r.mul_add(C[7], C[6]));
    let q8 = r2.mul_add(r.mul_add(C[13], C[12]), r.mul_add(C[11], C[10]));
    let power = 1.0 + r2.mul_add(r4.mul_add(r4.mul_add(q8, q4), q0), r);
    f64::from_bits(power.to_bits().wrapping_add(shifted.to_bits() << 52))
}

const fn inverse_factorials() -> [f64; 14] {
    let mut factorial = 1_u64;
    let mut inverse = [1.0; 14];
    let mut n = 1;
    while n < 14 {
        factorial *= n as u64;
        inverse[n] = 1.0 / factorial as f64;
        n += 1;
    }
    inverse
}

/// Runs `kernel` compiled for the widest vector instructions that the machine has.
///
/// The closure and what it calls must be `#[inline(always)]` to be compiled with them.
#[inline(always)]
pub(crate) fn with_widest_vectors<R>(kernel: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(kernel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_standard_library() {
        let mut worst = 0.0_f64;
        for i in 0..=2_000_000 {
            let t = -708.0 + 1416.0 * f64::from(i) / 2_000_000.0;
            worst = worst.max((exponential(t) / t.exp() - 1.0).abs());
        }
        for i in -1_000_000..=1_000_000 {
            let t = 1e-6 * f64::from(i);
            worst = worst.max((exponential(t) / t.exp() - 1.0).abs());
        }
        assert!(worst < 4.5e-16, "relative error {worst:e}");
    }

    #[test]
    fn clamps_and_keeps_nan() {
        assert_eq!(exponential(0.0), 1.0);
        assert_eq!(exponential(1e300), exponential(708.0));
        assert_eq!(exponential(f64::NEG_INFINITY), exponential(-708.0));
        assert!(exponential(f64::INFINITY).is_finite() && exponential(-1e9) > 0.0);
        assert!(exponential(f64::NAN).is_nan());
    }
}
