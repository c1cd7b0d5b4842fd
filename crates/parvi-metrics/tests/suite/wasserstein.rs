//! Transport on the line and along directions against matched samples, closed forms and the level of random samples.

use crate::common::{normal_points, points_strategy, uniform_weights};
use parvi_metrics::{Cloud, Directions, MetricError, SlicedReference, sliced_wasserstein, wasserstein_1d};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng, rngs::ChaCha12Rng};

/// W_p^p of two samples of sizes M and N by N copies of one and M of the other, matched in order.
fn by_copies(a: &[[f64; 1]], b: &[[f64; 1]], order: f64) -> f64 {
    let spread = |points: &[[f64; 1]], times: usize| {
        let mut values: Vec<f64> = points.iter().flat_map(|x| std::iter::repeat_n(x[0], times)).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let (x, y) = (spread(a, b.len()), spread(b, a.len()));
    x.iter().zip(&y).map(|(x, y)| (x - y).abs().powf(order)).sum::<f64>() / x.len() as f64
}

proptest! {
    #[test]
    fn the_merged_steps_match_copies(a in points_strategy::<1>(), b in points_strategy::<1>()) {
        let (first, second) = (Cloud::new(&a).unwrap(), Cloud::new(&b).unwrap());
        for order in [1.0, 1.5, 2.0, 4.0] {
            let value = wasserstein_1d(&first, &second, order).unwrap();
            prop_assert!((value.powf(order) - by_copies(&a, &b, order)).abs() < 1e-10);
        }
    }

    /// W₁ = ∫ |F − G| for weighted samples, with F and G evaluated between all neighbouring values.
    #[test]
    fn order_one_is_the_area_between_the_distribution_functions(
        a in points_strategy::<1>(), b in points_strategy::<1>(), weights in prop::collection::vec(0.0..1.0f64, 40),
    ) {
        prop_assume!(weights[..a.len()].iter().sum::<f64>() > 0.0);
        let (first, second) = (Cloud::weighted(&a, &weights[..a.len()]).unwrap(), Cloud::new(&b).unwrap());
        let below = |cloud: &Cloud<'_, 1>, x: f64| cloud.iter().filter(|(y, _)| y[0] <= x).map(|(_, w)| w).sum::<f64>();
        let mut values: Vec<f64> = a.iter().chain(&b).map(|x| x[0]).collect();
        values.sort_by(f64::total_cmp);
        let area: f64 =
            values.windows(2).map(|w| (w[1] - w[0]) * (below(&first, w[0]) - below(&second, w[0])).abs()).sum();
        prop_assert!((wasserstein_1d(&first, &second, 1.0).unwrap() - area).abs() < 1e-12);
    }

    /// A translation by t costs |t|; along evenly spread directions of the plane |t|/√2.
    #[test]
    fn a_translation_costs_its_length(a in points_strategy::<2>(), t in prop::array::uniform2(-4.0..4.0f64)) {
        let moved: Vec<[f64; 2]> = a.iter().map(|x| [x[0] + t[0], x[1] + t[1]]).collect();
        let directions = Directions::evenly_spread(11).unwrap();
        let value = sliced_wasserstein(&Cloud::new(&a).unwrap(), &Cloud::new(&moved).unwrap(), &directions).unwrap();
        prop_assert!((value - t[0].hypot(t[1]) / 2f64.sqrt()).abs() < 1e-12);
    }

    /// A turn of the clouds by the angle between two directions permutes the directions.
    #[test]
    fn a_turn_by_one_direction_changes_nothing(a in points_strategy::<2>(), b in points_strategy::<2>()) {
        let (s, c) = (std::f64::consts::PI / 8.0).sin_cos();
        let turn = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect()
        };
        let value = |a: &[[f64; 2]], b: &[[f64; 2]]| {
            let directions = Directions::evenly_spread(8).unwrap();
            sliced_wasserstein(&Cloud::new(a).unwrap(), &Cloud::new(b).unwrap(), &directions).unwrap()
        };
        prop_assert!((value(&a, &b) - value(&turn(&a), &turn(&b))).abs() < 1e-12);
    }
}

/// High orders and far scales, where powers of distances are beyond all numbers.
#[test]
fn every_order_has_the_scale_of_the_points() {
    let (a, b) = ([[0.0], [1.0], [2.0]], [[0.5], [1.25], [2.0]]);
    for scale in [1e-200, 1e-4, 1e200] {
        let (x, y) = (a.map(|[x]| [x * scale]), b.map(|[y]| [y * scale]));
        let distance = |order| wasserstein_1d(&Cloud::new(&x).unwrap(), &Cloud::new(&y).unwrap(), order);
        for order in [1.5_f64, 3.0, 300.0] {
            let expected = 0.5 * ((1.0 + 0.5_f64.powf(order)) / 3.0).powf(order.recip());
            let value = distance(order).unwrap() / scale;
            assert!(
                (value / expected - 1.0).abs() < 1e-14,
                "{scale} {order}: {value} {expected}"
            );
        }
        assert_eq!(
            wasserstein_1d(&Cloud::new(&x).unwrap(), &Cloud::new(&x).unwrap(), 3.0),
            Ok(0.0)
        );
    }
}

#[test]
fn sliced_is_the_mean_over_directions() {
    let (a, b) = (normal_points::<3>(50, 1), normal_points::<3>(70, 2));
    let (w, u) = (uniform_weights(50, 3), uniform_weights(70, 4));
    let directions = Directions::evenly_spread(6).unwrap();
    let project = |points: &[[f64; 3]], v: &[f64; 3]| -> Vec<[f64; 1]> {
        points
            .iter()
            .map(|x| [x[0] * v[0] + x[1] * v[1] + x[2] * v[2]])
            .collect()
    };
    let mut mean = 0.0;
    for v in directions.vectors() {
        let (x, y) = (project(&a, v), project(&b, v));
        let (x, y) = (Cloud::weighted(&x, &w).unwrap(), Cloud::weighted(&y, &u).unwrap());
        mean += wasserstein_1d(&x, &y, 2.0).unwrap().powi(2) / 6.0;
    }
    let (a, b) = (Cloud::weighted(&a, &w).unwrap(), Cloud::weighted(&b, &u).unwrap());
    let value = sliced_wasserstein(&a, &b, &directions).unwrap();
    assert!((value - mean.sqrt()).abs() < 1e-14);
    assert_eq!(SlicedReference::new(&b, directions).distance(&a).unwrap(), value);
}

/// Two uniform samples of size n: E W₂² = 1/n Σ_i 2 Var U_(i) = 1/3(n + 1), from the order statistics' variances.
#[test]
fn random_samples_have_the_expected_level() {
    let mut rng = ChaCha12Rng::seed_from_u64(6);
    let (n, repetitions) = (40, 2000);
    let mut mean = 0.0;
    for _ in 0..repetitions {
        let mut draw = || -> Vec<[f64; 1]> { (0..n).map(|_| [rng.random_range(0.0..1.0)]).collect() };
        let (a, b) = (draw(), draw());
        mean += wasserstein_1d(&Cloud::new(&a).unwrap(), &Cloud::new(&b).unwrap(), 2.0)
            .unwrap()
            .powi(2);
    }
    let ratio = mean / repetitions as f64 * 3.0 * (n as f64 + 1.0);
    assert!((ratio - 1.0).abs() < 0.08, "{ratio}");
}

#[test]
fn bad_orders_and_overflow_are_errors() {
    let cloud = Cloud::new(&[[0.0], [1e200]]).unwrap();
    let other = Cloud::new(&[[0.0]]).unwrap();
    assert!(matches!(
        wasserstein_1d(&cloud, &other, 0.5),
        Err(MetricError::InvalidParameter { value: 0.5, .. })
    ));
    assert!(wasserstein_1d(&cloud, &other, f64::NAN).is_err());
    assert!(matches!(
        wasserstein_1d(&cloud, &other, 2.0),
        Err(MetricError::Overflow { .. })
    ));
    assert!(wasserstein_1d(&cloud, &other, 1.0).is_ok());
}
