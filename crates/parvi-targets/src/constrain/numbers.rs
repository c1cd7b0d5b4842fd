//! Scalar functions the transforms share.

/// Exponents are cut at ±this: e^±700 and its inverse are normal numbers, with room for a factor of 10⁴.
pub(crate) const EXPONENT_LIMIT: f64 = 700.0;

/// e^−700: what stands for a positive number that rounds to zero.
pub(crate) const SMALLEST: f64 = 9.859_676_543_759_77e-305;

/// e^y, with y cut at ±700.
pub(crate) fn exponential(y: f64) -> f64 {
    y.clamp(-EXPONENT_LIMIT, EXPONENT_LIMIT).exp()
}

/// e^−|y|, with |y| cut at 700.
pub(crate) fn decay(y: f64) -> f64 {
    exponential(-y.abs())
}

/// 1 / cosh y = 2 e^−|y| / (1 + e^−2|y|).
pub(crate) fn hyperbolic_secant(y: f64) -> f64 {
    let e = decay(y);
    2.0 * e / (1.0 + e * e)
}

/// log(1 − tanh² y) = −2 log cosh y, without overflow and without cancellation far out.
pub(crate) fn log_one_minus_tanh_squared(y: f64) -> f64 {
    let size = y.abs();
    -2.0 * (size + (-2.0 * size).exp().ln_1p() - std::f64::consts::LN_2)
}

/// x, or `floor` where it is below that; NaN stays NaN.
pub(crate) fn at_least(floor: f64, x: f64) -> f64 {
    if x < floor { floor } else { x }
}

/// x, moved into the open interval (lower, upper) where rounding has put it on an end; NaN stays NaN.
pub(crate) fn inside(x: f64, [lower, upper]: [f64; 2]) -> f64 {
    let [low, high] = inner(lower, upper);
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// The outermost numbers that a coordinate of the open interval (lower, upper) takes: the neighbours of its ends, and for
/// an end at zero ±[`SMALLEST`], so that a score c / x stays finite.
pub(crate) fn inner(lower: f64, upper: f64) -> [f64; 2] {
    [
        lower.next_up().max(lower + SMALLEST),
        upper.next_down().min(upper - SMALLEST),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_number_is_the_exponential_of_the_limit() {
        assert!(((-EXPONENT_LIMIT).exp() / SMALLEST - 1.0).abs() < 1e-14);
        assert_eq!(exponential(-1e9), exponential(-EXPONENT_LIMIT));
        assert!(exponential(f64::NAN).is_nan());
    }

    #[test]
    fn hyperbolic_functions_hold_in_the_tails() {
        for y in [0.0, 1e-9, -0.3, 2.0, -15.0] {
            let exact: f64 = 1.0 / f64::cosh(y);
            assert!((hyperbolic_secant(y) / exact - 1.0).abs() < 1e-15);
            assert!((log_one_minus_tanh_squared(y) - 2.0 * exact.ln()).abs() < 1e-15 * (1.0 + y.abs()));
        }
        assert!((log_one_minus_tanh_squared(-1e6) + 2e6 - 4_f64.ln()).abs() < 1e-9);
        assert!(hyperbolic_secant(1e6) > 0.0);
    }

    #[test]
    fn the_inside_of_an_interval_excludes_its_ends() {
        assert_eq!(inside(0.0, [0.0, 1.0]), SMALLEST);
        assert_eq!(inside(1.0, [0.0, 1.0]), 1.0_f64.next_down());
        assert_eq!(inside(0.5, [0.0, 1.0]), 0.5);
        assert_eq!(inside(f64::INFINITY, [2.0, f64::INFINITY]), f64::MAX);
        assert_eq!(inside(2.0, [2.0, f64::INFINITY]), 2.0_f64.next_up());
        assert!(inside(f64::NAN, [0.0, 1.0]).is_nan());
    }
}
