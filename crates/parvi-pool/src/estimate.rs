//! An expectation and how far it may be off.

use std::ops::RangeInclusive;

/// An expectation with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error, by the spread of the weights: of the probability of an event that few points meet far too small, and 0 where none does.
    pub standard_error: f64,
    /// (Σ |w f|)² / Σ (w f)² over the points at which the target was evaluated: how many of equal weight carry the value. Of an event it is the effective size of the points that meet
    /// it, 0 where none does.
    pub carriers: f64,
}

impl Estimate {
    /// Σ c f ± (Σ c² (f − f̄)²)^½ of terms (c, f, whether the target was evaluated there): those where it was count in the error and carry the value. And the largest |c (f − f̄)| of the others.
    pub(crate) fn of_terms(terms: impl Iterator<Item = (f64, f64, bool)>) -> (Self, f64) {
        let terms: Vec<_> = terms.collect();
        let value: f64 = terms.iter().map(|(c, f, _)| c * f).sum();
        let (mut variance, mut largest) = (0.0, 0.0);
        let carried = terms.iter().filter(|(.., evaluated)| *evaluated);
        let carriers = carriers(carried.map(|(c, f, _)| (c * f).abs()));
        let unit = unit_of_squares(terms.iter().map(|(c, f, _)| c * f));
        for (c, f, evaluated) in terms {
            let term = c * (f - value);
            if evaluated {
                let scaled = term / unit;
                variance += scaled * scaled;
            } else {
                largest = f64::max(largest, term.abs());
            }
        }
        let standard_error = unit * f64::sqrt(variance);
        let estimate = Self {
            value,
            standard_error,
            carriers,
        };
        (estimate, largest)
    }
}

/// What numbers are divided by before they are squared: 1, or the largest of their sizes where its square is no number to rely on, as of likelihoods.
pub fn unit_of_squares(numbers: impl Iterator<Item = f64>) -> f64 {
    let largest = numbers.map(f64::abs).fold(0.0, f64::max);
    let is_far_out = largest > 0.0 && largest.is_finite() && !SQUARED_AS_THEY_ARE.contains(&largest);
    if is_far_out { largest } else { 1.0 }
}

/// Numbers that are squared as they are.
const SQUARED_AS_THEY_ARE: RangeInclusive<f64> = 1e-100..=1e100;

/// (Σ a)² / Σ a² of numbers a ≥ 0; 0 of zeros.
fn carriers(sizes: impl Iterator<Item = f64> + Clone) -> f64 {
    let largest = sizes.clone().fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return 0.0;
    }
    // Over the largest, so that no square overflows.
    let (mut sum, mut squares) = (0.0, 0.0);
    for size in sizes.map(|size| size / largest) {
        sum += size;
        squares += size * size;
    }
    sum * sum / squares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_in_units_of_its_function() {
        let error = |unit: f64| {
            let terms = [(0.4, unit), (0.2, 3.0 * unit), (0.4, -unit)];
            let (estimate, _) = Estimate::of_terms(terms.into_iter().map(|(c, f)| (c, f, true)));
            estimate.standard_error / unit
        };
        let expected = error(1.0);
        assert!(expected > 0.1);
        for unit in [1e-300, 1e-170, 1e-99, 1e99, 1e170, 1e300] {
            assert!((error(unit) / expected - 1.0).abs() < 1e-12, "{unit}: {}", error(unit));
        }
    }

    #[test]
    fn an_event_is_carried_by_the_points_that_meet_it() {
        let of = |events: [f64; 4], evaluated: [bool; 4]| {
            let weights = [0.4, 0.2, 0.2, 0.2];
            let terms = weights.into_iter().zip(events).zip(evaluated);
            Estimate::of_terms(terms.map(|((c, f), evaluated)| (c, f, evaluated))).0
        };
        let none = of([0.0; 4], [true; 4]);
        assert_eq!((none.value, none.standard_error, none.carriers), (0.0, 0.0, 0.0));
        assert!((of([0.0, 1.0, 1.0, 1.0], [true; 4]).carriers - 3.0).abs() < 1e-12);
        assert!((of([0.0, 1.0, 1.0, -1e200], [true, true, false, true]).carriers - 1.0).abs() < 1e-12);
        assert!((of([1.0, 1.0, 0.0, 0.0], [true; 4]).carriers - 1.8).abs() < 1e-12);
    }
}
