//! Sums that do not depend on the number of threads and hardly on rounding.

/// Neumaier's compensated sum: the error does not grow with the number of terms.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CompensatedSum {
    sum: f64,
    compensation: f64,
}

impl CompensatedSum {
    /// Adds one term.
    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        self.compensation += if self.sum.abs() >= term.abs() {
            (self.sum - sum) + term
        } else {
            (term - sum) + self.sum
        };
        self.sum = sum;
    }

    /// The sum so far; an overflow stays infinite rather than turning into NaN.
    pub(crate) fn value(&self) -> f64 {
        if self.sum.is_finite() {
            self.sum + self.compensation
        } else {
            self.sum
        }
    }
}

/// Compensated sum in the order of the iterator.
pub(crate) fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
    let mut total = CompensatedSum::default();
    for term in terms {
        total.add(term);
    }
    total.value()
}

/// Σ_c `term(c)` over `0..count`: terms in parallel, added in order, so the bits are those of one thread.
pub(crate) fn parallel_sum(count: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    sum(mpm_parallel::collect(count, 1, &term))
}

/// Number of items per term of [`chunked_sum`].
const CHUNK: usize = 64;

/// Σ_i `term(i)` over `0..count` in fixed chunks: for terms too small to be worth a task each.
pub(crate) fn chunked_sum(count: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    parallel_sum(count.div_ceil(CHUNK), |chunk| {
        sum((chunk * CHUNK..count.min((chunk + 1) * CHUNK)).map(&term))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cancellation_is_compensated() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
        assert_eq!(sum((0..10_000_000).map(|_| 0.1)), 1e6);
        assert_eq!(sum([f64::MAX, f64::MAX]), f64::INFINITY);
    }

    #[test]
    fn chunks_cover_every_index_once() {
        for count in [0, 1, 63, 64, 65, 1000] {
            let expected = (0..count).map(|i| i as f64).sum::<f64>();
            assert_eq!(chunked_sum(count, |i| i as f64), expected);
        }
    }
}
