//! Maxima that do not lose what is not a number.

/// The larger of two values; NaN if either is. (`f64::max` drops NaN.)
#[inline(always)]
pub fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::larger_or_nan;

    #[test]
    fn not_a_number_survives_on_either_side() {
        assert_eq!(larger_or_nan(1.0, 2.0), 2.0);
        assert_eq!(larger_or_nan(2.0, 1.0), 2.0);
        assert!(larger_or_nan(f64::NAN, 1.0).is_nan());
        assert!(larger_or_nan(1.0, f64::NAN).is_nan());
        assert!(larger_or_nan(f64::NAN, f64::INFINITY).is_nan());
    }
}
