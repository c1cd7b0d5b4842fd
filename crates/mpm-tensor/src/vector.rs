//! Vectors of compile-time dimension: free functions on `[f64; D]`.
//!
//! Vectors are plain arrays, so particle storage is a `Vec<[f64; D]>` and literals need no constructor. No function
//! here panics; NaN and infinite components follow IEEE 754.

/// a b + c: rounded once where the machine does it in one instruction, else twice.
#[inline(always)]
pub fn multiply_add(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}

/// The scalar product a · b = Σ_i a_i b_i, summed in the order of the axes.
#[inline]
pub fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for i in 0..D {
        sum += a[i] * b[i];
    }
    sum
}

/// The squared Euclidean norm ‖a‖² = a · a.
#[inline]
pub fn norm_squared<const D: usize>(a: &[f64; D]) -> f64 {
    dot(a, a)
}

/// The Euclidean norm ‖a‖ = √(a · a).
///
/// Components are squared without scaling: accurate for 1e-146 < ‖a‖ < 1e154, infinite or rounded towards zero outside.
#[inline]
pub fn norm<const D: usize>(a: &[f64; D]) -> f64 {
    norm_squared(a).sqrt()
}

/// The sum a + b.
#[inline]
pub fn add<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    let mut sum = *a;
    for i in 0..D {
        sum[i] += b[i];
    }
    sum
}

/// The difference a − b.
#[inline]
pub fn subtract<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    let mut difference = *a;
    for i in 0..D {
        difference[i] -= b[i];
    }
    difference
}

/// The multiple `factor` · a.
#[inline]
pub fn scale<const D: usize>(a: &[f64; D], factor: f64) -> [f64; D] {
    let mut scaled = *a;
    for component in &mut scaled {
        *component *= factor;
    }
    scaled
}

/// The linear update a + `factor` · b.
#[inline]
pub fn add_scaled<const D: usize>(a: &[f64; D], factor: f64, b: &[f64; D]) -> [f64; D] {
    let mut sum = *a;
    accumulate(&mut sum, factor, b);
    sum
}

/// The linear update in place, a ← a + `factor` · b.
#[inline]
pub fn accumulate<const D: usize>(a: &mut [f64; D], factor: f64, b: &[f64; D]) {
    for i in 0..D {
        a[i] += factor * b[i];
    }
}

/// The squared Euclidean distance ‖a − b‖².
#[inline]
pub fn distance_squared<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    norm_squared(&subtract(a, b))
}

/// The Euclidean distance ‖a − b‖, in the range stated at [`norm`].
#[inline]
pub fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    distance_squared(a, b).sqrt()
}

/// The largest component in absolute value, max_i |a_i|; zero for D = 0, NaN if a component is NaN.
#[inline]
pub fn maximum_norm<const D: usize>(a: &[f64; D]) -> f64 {
    let mut largest = 0.0;
    for component in a {
        if component.is_nan() {
            return f64::NAN;
        }
        largest = component.abs().max(largest);
    }
    largest
}

/// Whether every component is finite (neither NaN nor infinite).
#[inline]
pub fn is_finite<const D: usize>(a: &[f64; D]) -> bool {
    a.iter().all(|component| component.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_norms_follow_their_formulas() {
        let a = [3.0, -4.0];
        assert_eq!(dot(&a, &[2.0, 1.0]), 2.0);
        assert_eq!(norm_squared(&a), 25.0);
        assert_eq!(norm(&a), 5.0);
        assert_eq!(maximum_norm(&a), 4.0);
        assert_eq!(distance(&a, &[0.0, 0.0]), 5.0);
        assert_eq!(distance_squared(&a, &[3.0, -2.0]), 4.0);
    }

    #[test]
    fn linear_updates_follow_their_formulas() {
        let (a, b) = ([1.0, 2.0, 3.0], [0.5, -1.0, 2.0]);
        assert_eq!(add(&a, &b), [1.5, 1.0, 5.0]);
        assert_eq!(subtract(&a, &b), [0.5, 3.0, 1.0]);
        assert_eq!(scale(&a, 2.0), [2.0, 4.0, 6.0]);
        assert_eq!(add_scaled(&a, 2.0, &b), [2.0, 0.0, 7.0]);
        let mut c = a;
        accumulate(&mut c, -2.0, &b);
        assert_eq!(c, [0.0, 4.0, -1.0]);
    }

    #[test]
    fn not_a_number_is_seen() {
        assert!(maximum_norm(&[1.0, f64::NAN, 3.0]).is_nan());
        assert!(maximum_norm(&[f64::NAN, 3.0]).is_nan());
        assert!(!is_finite(&[0.0, f64::INFINITY]));
        assert!(is_finite(&[0.0, -1e308]));
        assert_eq!(maximum_norm::<0>(&[]), 0.0);
    }
}
