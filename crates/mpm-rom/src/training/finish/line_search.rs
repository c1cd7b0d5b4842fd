//! The length of a step along a direction of descent.

/// Least decrease, as a part of what the slope at the start promises.
const DECREASE: f64 = 1e-4;
/// Largest slope at the end, as a part of that at the start.
const SLOPE: f64 = 0.9;
/// Evaluations before a search is given up.
const MOST: usize = 20;

/// A length λ > 0 that fulfils the weak conditions of Wolfe, f(λ) ≤ f(0) + 10⁻⁴ λ f′(0) and f′(λ) ≥ 0.9 f′(0), by doubling, parabolas and bisection from λ = 1
/// on. `evaluate` gives f and f′; values that are not finite count as too large. `None` after 20 evaluations, or where f′(0) ≥ 0. The last call of `evaluate` is that of the result.
pub(crate) fn search(start: f64, slope: f64, mut evaluate: impl FnMut(f64) -> (f64, f64)) -> Option<f64> {
    if slope.is_nan() || slope >= 0.0 {
        return None;
    }
    let (mut lower, mut upper, mut length) = ((0.0, start, slope), f64::INFINITY, 1.0);
    for _ in 0..MOST {
        let (value, there) = evaluate(length);
        let low_enough = value <= start + DECREASE * length * slope && there.is_finite();
        if low_enough && there >= SLOPE * slope {
            return Some(length);
        }
        if low_enough {
            lower = (length, value, there);
            length = if upper.is_finite() {
                0.5 * (length + upper)
            } else {
                2.0 * length
            };
        } else {
            upper = length;
            // The parabola through value and slope at the lower end and the value at the upper one.
            let (from, width) = (lower.0, upper - lower.0);
            let bend = value - lower.1 - width * lower.2;
            let least = -0.5 * lower.2 * width * width / bend;
            length = if least.is_finite() {
                from + least.clamp(0.1 * width, 0.5 * width)
            } else {
                from + 0.1 * width
            };
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_conditions_hold_at_the_length_found() {
        // f = (λ − m)² has its minimum far on, near, and close to the start.
        for least in [1e3, 1.0, 1e-3] {
            let f = |x: f64| ((x - least).powi(2), 2.0 * (x - least));
            let (start, slope) = f(0.0);
            let found = search(start, slope, f).expect("a parabola has one");
            let (value, there) = f(found);
            assert!(
                value <= start + 1e-4 * found * slope && there >= 0.9 * slope,
                "{least}: {found}"
            );
        }
    }

    #[test]
    fn values_that_are_not_finite_are_too_far() {
        let f = |x: f64| {
            if x > 0.01 {
                (f64::NAN, f64::NAN)
            } else {
                (-x, -1.0 + 80.0 * x)
            }
        };
        let found = search(0.0, -1.0, f).expect("there is one before");
        assert!(found <= 0.01);
    }

    #[test]
    fn there_is_none_uphill_and_none_without_bottom() {
        assert_eq!(search(0.0, 1.0, |x| (x, 1.0)), None);
        assert_eq!(search(0.0, -1.0, |x| (-x, -1.0)), None);
    }
}
