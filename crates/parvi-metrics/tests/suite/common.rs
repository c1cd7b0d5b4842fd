//! Points and weights that the tests share.
#![allow(dead_code)] // not every test file uses all of it

use parvi_metrics::Cloud;
use proptest::prelude::*;
use rand::{RngExt, SeedableRng, rngs::ChaCha12Rng};
use rand_distr::StandardNormal;

/// Independent standard Gaussian points.
pub fn normal_points<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| std::array::from_fn(|_| rng.sample(StandardNormal)))
        .collect()
}

/// The mean of a statistic over sets of so many independent standard Gaussian points, of seeds from the first one on.
pub fn mean_over_draws<const D: usize>(
    count: usize,
    seeds: std::ops::Range<u64>,
    statistic: impl Fn(&Cloud<'_, D>) -> f64,
) -> f64 {
    let sets = (seeds.end - seeds.start) as f64;
    let of_seed = |seed| statistic(&Cloud::new(&normal_points::<D>(count, seed)).unwrap());
    seeds.map(of_seed).sum::<f64>() / sets
}

/// Independent uniform weights.
pub fn uniform_weights(count: usize, seed: u64) -> Vec<f64> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    (0..count).map(|_| rng.random_range(0.0..2.0)).collect()
}

/// Σ_ij w_i u_j f(x_i, y_j) as the definition has it, row by row.
pub fn double_sum<const D: usize>(a: &Cloud<'_, D>, b: &Cloud<'_, D>, f: impl Fn(&[f64; D], &[f64; D]) -> f64) -> f64 {
    a.iter()
        .map(|(x, w)| w * b.iter().map(|(y, u)| u * f(x, y)).sum::<f64>())
        .sum()
}

/// |x − y|².
pub fn squared_distance<const D: usize>(x: &[f64; D], y: &[f64; D]) -> f64 {
    x.iter().zip(y).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// Up to 40 points of a box.
pub fn points_strategy<const D: usize>() -> impl Strategy<Value = Vec<[f64; D]>> {
    prop::collection::vec(prop::array::uniform(-5.0..5.0f64), 2..40)
}

/// Every point as often as its count says.
pub fn copies<const D: usize>(points: &[[f64; D]], counts: &[f64]) -> Vec<[f64; D]> {
    points
        .iter()
        .zip(counts)
        .flat_map(|(x, n)| std::iter::repeat_n(*x, *n as usize))
        .collect()
}
