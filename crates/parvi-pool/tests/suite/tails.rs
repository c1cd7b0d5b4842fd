//! Second moments of laws with heavy tails, most of which few points would meet.

use parvi_targets::Target;

use crate::common::pool_of;

/// A Student law of every coordinate by itself, ν = 3, whose variance is 3: arms along the axes.
struct Arms;

impl<const D: usize> Target<D> for Arms {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        x.iter().map(|x| -2.0 * (1.0 + x * x / 3.0).ln()).sum()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        x.map(|x| -4.0 * x / (3.0 + x * x))
    }
}

/// Variances over their truth, in order.
fn variances<const D: usize>(seeds: std::ops::Range<u64>) -> Vec<f64> {
    let mut all: Vec<f64> = seeds
        .flat_map(|seed| {
            let pool = pool_of::<D>(&Arms, 500, seed).unwrap();
            assert!(pool.verdict.pareto_k.is_none_or(|k| k < 1.0), "{:?}", pool.verdict);
            (0..D).map(move |axis| pool.expectation(|x| x[axis] * x[axis]).value / 3.0)
        })
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn variances_of_heavy_tails_are_met() {
    for (values, median) in [(variances::<1>(0..8), 0.03), (variances::<3>(0..8), 0.06)] {
        let middle = values[values.len() / 2];
        assert!((middle - 1.0).abs() < median, "{values:?}");
        assert!(values[0] > 0.8 && values[values.len() - 1] < 1.25, "{values:?}");
    }
}
