//! Scalar functions the targets share: quantiles, a stable log(1 + eᵗ) and log cosh t.

use statrs::function::erf::erfc_inv;
use statrs::function::gamma::{gamma_lr, gamma_ur, ln_gamma};

/// ½ ln 2π.
pub(crate) const HALF_LOG_TWO_PI: f64 = 0.918_938_533_204_672_8;

/// The quantile Φ⁻¹(u) of the standard normal distribution, for u in (0, 1).
///
/// Φ⁻¹(u) = −√2 erfc⁻¹(2u), which keeps its relative accuracy in the lower tail. Outside of (0, 1) it is ±∞.
pub fn normal_quantile(u: f64) -> f64 {
    if u <= 0.0 {
        f64::NEG_INFINITY
    } else if u >= 1.0 {
        f64::INFINITY
    } else {
        -std::f64::consts::SQRT_2 * erfc_inv(2.0 * u)
    }
}

/// log(1 + eᵗ) without overflow and without cancellation.
pub(crate) fn log_one_plus_exp(t: f64) -> f64 {
    t.max(0.0) + (-t.abs()).exp().ln_1p()
}

/// log cosh t without overflow.
#[cfg(feature = "catalogue")]
pub(crate) fn log_cosh(t: f64) -> f64 {
    let size = t.abs();
    size + (-2.0 * size).exp().ln_1p() - std::f64::consts::LN_2
}

/// The root of an increasing function inside a bracket, by Newton steps with the function's derivative where they stay
/// inside the bracket, which shrinks with every evaluation, and by bisection where they do not.
pub(crate) fn increasing_root(
    function: impl Fn(f64) -> f64,
    derivative: impl Fn(f64) -> f64,
    [mut low, mut high]: [f64; 2],
    start: f64,
) -> f64 {
    let mut root = start.clamp(low, high);
    for _ in 0..200 {
        let value = function(root);
        if value > 0.0 {
            high = root;
        } else {
            low = root;
        }
        let newton = root - value / derivative(root);
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        let moved = (next - root).abs();
        root = next;
        if moved <= 2.0 * f64::EPSILON * root.abs() {
            break;
        }
    }
    root
}

/// The quantile of the gamma distribution with the given shape and rate 1, for u in (0, 1); 0 and ∞ at its ends, NaN for what is no shape or no probability.
///
/// The root in y = ln x of the incomplete gamma function (the smaller tail), started from the Wilson–Hilferty
/// approximation or, in the far lower tail, from the leading term xᵃ / Γ(a + 1), which is a lower bound. For shapes above 10⁷, where that function takes √a terms that cancel, the first five terms of
/// the expansion about the normal law (E. A. Cornish, R. A. Fisher, *Moments and cumulants in the specification of distributions*, 1938), which are right to rounding.
pub fn gamma_quantile(shape: f64, u: f64) -> f64 {
    if !(shape > 0.0 && shape.is_finite() && (0.0..=1.0).contains(&u)) {
        return f64::NAN;
    }
    if u == 0.0 || u == 1.0 {
        return if u == 0.0 { 0.0 } else { f64::INFINITY };
    }
    if shape > LARGE_SHAPE {
        return large_gamma_quantile(shape, normal_quantile(u));
    }
    let excess = |y: f64| {
        let x = y.exp();
        if u > 0.5 {
            (1.0 - u) - gamma_ur(shape, x)
        } else {
            gamma_lr(shape, x) - u
        }
    };
    let log_gamma = ln_gamma(shape);
    let density = |y: f64| (shape * y - y.exp() - log_gamma).exp();
    let lower_bound = (u.ln() + ln_gamma(shape + 1.0)) / shape;
    let cube_root = 1.0 - 1.0 / (9.0 * shape) + normal_quantile(u) / (3.0 * shape.sqrt());
    let start = if cube_root > 0.2 {
        shape.ln() + 3.0 * cube_root.ln()
    } else {
        lower_bound
    };
    let bracket = [
        (lower_bound - 1e-3).max(-740.0),
        (shape + 100.0 + 20.0 * shape.sqrt()).ln().max(lower_bound),
    ];
    increasing_root(excess, density, bracket, start).exp()
}

/// The shape of a gamma law from which on it is expanded about the normal one.
const LARGE_SHAPE: f64 = 1e7;

/// [`gamma_quantile`] of a large shape a from the normal quantile z: a + z √a + (z² − 1)/3 + (z³ − 7 z)/(36 √a) − (3 z⁴ + 7 z² − 16)/(810 a).
fn large_gamma_quantile(shape: f64, z: f64) -> f64 {
    let (root, square) = (shape.sqrt(), z * z);
    let small = (square - 1.0) / 3.0 + z * (square - 7.0) / (36.0 * root)
        - (square * (3.0 * square + 7.0) - 16.0) / (810.0 * shape);
    shape + z * root + small
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_quantile_has_its_known_values() {
        assert!(normal_quantile(0.5).abs() < 1e-15);
        assert!((normal_quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
        assert!((normal_quantile(1e-10) + 6.361_340_902_404_056).abs() < 1e-12);
        assert_eq!(normal_quantile(0.0), f64::NEG_INFINITY);
    }

    #[test]
    fn gamma_quantile_inverts_the_distribution_function() {
        for shape in [0.1, 0.25, 0.5, 1.0, 1.5, 2.5, 10.0, 200.0] {
            for u in [1e-12, 1e-6, 0.01, 0.3, 0.5, 0.500001, 0.9, 0.999, 1.0 - 1e-10] {
                let x = gamma_quantile(shape, u);
                let back = gamma_lr(shape, x);
                assert!(
                    (back - u).abs() <= 1e-12 * u + 1e-15,
                    "shape {shape}, u {u}: x {x}, P {back}"
                );
            }
        }
        // The function itself is right to 1e-9 there.
        for u in [1e-6, 0.3, 0.5, 0.999] {
            let [below, above] = [0.9e7, 1.1e7].map(|shape| (gamma_lr(shape, gamma_quantile(shape, u)) - u).abs());
            assert!(below < 1e-7 && above < 1e-7, "{u}: {below:e} {above:e}");
        }
        assert_eq!(gamma_quantile(1e300, 0.3), 1e300);
        // Shape 1 is the exponential distribution.
        assert!((gamma_quantile(1.0, 0.3) + (0.7_f64).ln()).abs() < 1e-14);
        assert_eq!([0.0, 1.0].map(|u| gamma_quantile(2.5, u)), [0.0, f64::INFINITY]);
        let none = [
            (0.0, 0.5),
            (-1.0, 0.5),
            (f64::NAN, 0.5),
            (f64::INFINITY, 0.5),
            (1.0, -0.1),
            (1.0, 1.1),
            (1.0, f64::NAN),
        ];
        assert!(none.iter().all(|&(shape, u)| gamma_quantile(shape, u).is_nan()));
    }

    #[test]
    fn log_one_plus_exp_is_stable() {
        assert_eq!(log_one_plus_exp(1000.0), 1000.0);
        assert_eq!(log_one_plus_exp(-1000.0), 0.0);
        assert!((log_one_plus_exp(0.0) - std::f64::consts::LN_2).abs() < 1e-16);
    }

    #[cfg(feature = "catalogue")]
    #[test]
    fn log_cosh_is_stable() {
        assert_eq!(log_cosh(0.0), 0.0);
        assert!((log_cosh(-1.3) - 1.3_f64.cosh().ln()).abs() < 1e-15);
        assert!((log_cosh(1e300) / 1e300 - 1.0).abs() < 1e-15);
    }
}
