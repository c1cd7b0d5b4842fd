//! An expectation and how far it may be off.

use std::ops::RangeInclusive;

/// Blocks that free draws are cut into.
const BLOCKS: usize = 8;

/// 1 − Σ s_k² below which one of the parts is all.
const LEAST_LEFT: f64 = 1e-3;

/// An expectation with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error, by the spread of the weights and of free draws: of the probability of an event that few points meet far too small, and 0 where none does.
    pub standard_error: f64,
    /// (Σ |w f|)² / Σ (w f)² over the points at which the target was evaluated: how many of equal weight carry the value. Of an event it is the effective size of the points that meet
    /// it, 0 where none does.
    pub carriers: f64,
}

impl Estimate {
    /// Σ c f ± (Σ c² (f − f̄)² + Σ v)^½ of terms (c, f, whether the target was evaluated there): the first sum is over those where it was, which carry the value; v is that of each run of others, the free
    /// draws of one proposal, by [how far blocks of them are apart](variance_by_blocks). And the largest |c (f − f̄)| of these.
    pub(crate) fn of_terms(terms: &[(f64, f64, bool)]) -> (Self, f64) {
        let value: f64 = terms.iter().map(|(c, f, _)| c * f).sum();
        let (mut variance, mut largest) = (0.0, 0.0);
        let carried = terms.iter().filter(|(.., evaluated)| *evaluated);
        let carriers = carriers(carried.map(|(c, f, _)| (c * f).abs()));
        let unit = unit_of_squares(terms.iter().map(|(c, f, _)| c * f));
        let share = |(c, f, _): &(f64, f64, bool)| c * (f - value);
        for run in terms.chunk_by(|one, next| one.2 == next.2) {
            if run[0].2 {
                variance += run.iter().map(|term| (share(term) / unit).powi(2)).sum::<f64>();
            } else {
                largest = run.iter().map(|term| share(term).abs()).fold(largest, f64::max);
                variance += variance_by_blocks(run.len(), |index| share(&run[index]) / unit);
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

/// The standard error of Σ c f by how far apart independent parts of it are, given of each Σ c and Σ c (f − f̄): (Σ t_k² / (1 − Σ s_k²))^½ with shares s_k of the sum, for parts that count by the inverse of their variances; 0 of a single part.
pub(crate) fn error_between(parts: &[[f64; 2]]) -> f64 {
    let unit = unit_of_squares(parts.iter().map(|[_, deviation]| *deviation));
    let total: f64 = parts.iter().map(|[share, _]| share).sum();
    let left = 1.0 - parts.iter().map(|[share, _]| (share / total).powi(2)).sum::<f64>();
    let squares: f64 = parts.iter().map(|[_, deviation]| (deviation / unit).powi(2)).sum();
    if left > LEAST_LEFT {
        unit * (squares / left).sqrt()
    } else {
        0.0
    }
}

/// The variance of the sum of quasi-random terms, by that of the sums of blocks of neighbours: what is smooth is nearly the same in each, and of what no block resolves they are as good as independent.
fn variance_by_blocks(count: usize, term: impl Fn(usize) -> f64) -> f64 {
    let bounds = |block: usize| block * count / BLOCKS..(block + 1) * count / BLOCKS;
    let sums: [f64; BLOCKS] = std::array::from_fn(|block| bounds(block).map(&term).sum());
    let mean = sums.iter().sum::<f64>() / BLOCKS as f64;
    let squares = sums.iter().map(|sum| (sum - mean).powi(2)).sum::<f64>();
    squares * BLOCKS as f64 / (BLOCKS - 1) as f64
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
    use parvi_targets::normal_quantile;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::*;

    #[test]
    fn an_error_is_in_units_of_its_function() {
        let error = |unit: f64| {
            let terms = [(0.4, unit), (0.2, 3.0 * unit), (0.4, -unit)];
            let (estimate, _) = Estimate::of_terms(&terms.map(|(c, f)| (c, f, true)));
            estimate.standard_error / unit
        };
        let expected = error(1.0);
        assert!(expected > 0.1);
        for unit in [1e-300, 1e-170, 1e-99, 1e99, 1e170, 1e300] {
            assert!((error(unit) / expected - 1.0).abs() < 1e-12, "{unit}: {}", error(unit));
        }
    }

    #[test]
    fn independent_parts_are_as_far_apart_as_their_errors_say() {
        // Three parts of unequal errors, each counted by the inverse of its variance.
        let shares = [0.5, 0.3, 0.2];
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mean = (0..20_000).map(|_| {
            let values = shares.map(|share: f64| normal_quantile(rng.random_range(1e-12..1.0)) / share.sqrt());
            let all: f64 = values.iter().zip(shares).map(|(value, share)| share * value).sum();
            let parts = [0, 1, 2].map(|k| [shares[k], shares[k] * (values[k] - all)]);
            error_between(&parts).powi(2) / 20_000.0
        });
        let mean: f64 = mean.sum();
        assert!((mean - 1.0).abs() < 0.03, "{mean}");
        assert_eq!(error_between(&[[1.0, 0.0]]), 0.0);
        assert_eq!(error_between(&[]), 0.0);
        assert_eq!(error_between(&[[0.5, 1e300], [0.5, -1e300]]), 2e300);
    }

    #[test]
    fn what_blocks_agree_about_is_no_error() {
        let error = |f: &dyn Fn(f64) -> f64| {
            let terms: Vec<_> = (0..800)
                .map(|index| (1.0 / 800.0, f(f64::from(index)), false))
                .collect();
            Estimate::of_terms(&terms).0.standard_error
        };
        // What no block resolves is as good as independent, here of a variance of 1/12.
        let independent = (1.0_f64 / 12.0 / 800.0).sqrt();
        let rough = error(&|index| (0.754_877_666_246_692_7 * index * index).fract());
        assert!((0.5..2.0).contains(&(rough / independent)), "{rough} {independent}");
        let even = error(&|index| (0.618_033_988_749_895 * index).fract());
        assert!(even < 0.3 * independent, "{even} {independent}");
        assert!(error(&|_| 3.0) < 1e-15);
    }

    #[test]
    fn an_event_is_carried_by_the_points_that_meet_it() {
        let of = |events: [f64; 4], evaluated: [bool; 4]| {
            let weights = [0.4, 0.2, 0.2, 0.2];
            let terms = weights.into_iter().zip(events).zip(evaluated);
            let terms: Vec<_> = terms.map(|((c, f), evaluated)| (c, f, evaluated)).collect();
            Estimate::of_terms(&terms).0
        };
        let none = of([0.0; 4], [true; 4]);
        assert_eq!((none.value, none.standard_error, none.carriers), (0.0, 0.0, 0.0));
        assert!((of([0.0, 1.0, 1.0, 1.0], [true; 4]).carriers - 3.0).abs() < 1e-12);
        assert!((of([0.0, 1.0, 1.0, -1e200], [true, true, false, true]).carriers - 1.0).abs() < 1e-12);
        assert!((of([1.0, 1.0, 0.0, 0.0], [true; 4]).carriers - 1.8).abs() < 1e-12);
    }
}
