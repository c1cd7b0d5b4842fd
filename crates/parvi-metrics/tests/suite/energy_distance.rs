//! The energy distance against double sums written out, closed forms and invariances.

use crate::common::{double_sum, mean_over_draws, normal_points, points_strategy, squared_distance, uniform_weights};
use parvi_metrics::{Cloud, EnergyReference, MetricError, energy_distance_squared, mean_pair_distance};
use proptest::prelude::*;

/// E|x − y| as the definition has it.
fn naive_mean_distance<const D: usize>(a: &Cloud<'_, D>, b: &Cloud<'_, D>) -> f64 {
    double_sum(a, b, |x, y| squared_distance(x, y).sqrt())
}

fn naive<const D: usize>(a: &Cloud<'_, D>, b: &Cloud<'_, D>) -> f64 {
    2.0 * naive_mean_distance(a, b) - naive_mean_distance(a, a) - naive_mean_distance(b, b)
}

fn agrees_with_the_definition<const D: usize>() {
    for (m, n) in [(1, 1), (1, 7), (8, 9), (127, 300), (513, 129)] {
        let (points, other) = (normal_points::<D>(m, 1), normal_points::<D>(n, 2));
        let (w, u) = (uniform_weights(m, 3), uniform_weights(n, 4));
        for (a, b) in [
            (Cloud::new(&points).unwrap(), Cloud::new(&other).unwrap()),
            (
                Cloud::weighted(&points, &w).unwrap(),
                Cloud::weighted(&other, &u).unwrap(),
            ),
        ] {
            assert!((mean_pair_distance(&a).unwrap() - naive_mean_distance(&a, &a)).abs() < 1e-13);
            assert!((energy_distance_squared(&a, &b).unwrap() - naive(&a, &b)).abs() < 1e-13);
            if n > 1 {
                let reference = EnergyReference::new(&b).unwrap();
                let share = 1.0 - b.iter().map(|(_, u)| u * u).sum::<f64>();
                let own = naive_mean_distance(&b, &b);
                assert!((reference.mean_distance() - own / share).abs() < 1e-13);
                let expected = naive(&a, &b) + own - own / share;
                assert!((reference.squared(&a).unwrap() - expected).abs() < 1e-13);
            }
        }
    }
}

#[test]
fn agrees_with_the_definition_in_every_dimension() {
    mpm_tensor::in_dimensions!(agrees_with_the_definition(), 1, 2, 3, 6);
}

/// Two shifted copies of a long sample: the small difference of large sums keeps its digits.
#[test]
fn small_distances_keep_their_digits() {
    let points = normal_points::<2>(3000, 5);
    let far: Vec<[f64; 2]> = points.iter().map(|[x, y]| [x + 1e-2, *y]).collect();
    let (a, b) = (Cloud::new(&points).unwrap(), Cloud::new(&far).unwrap());
    // The same difference with each pair's terms taken together, so that nothing large cancels.
    let distance = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let mut expected = 0.0;
    for p in &points {
        let mut row = 0.0;
        for q in &points {
            row += 2.0 * distance(*p, [q[0] + 1e-2, q[1]]) - 2.0 * distance(*p, *q);
        }
        expected += row / 9e6;
    }
    let value = energy_distance_squared(&a, &b).unwrap();
    assert!(value > 1e-6 && value < 1e-3, "{value}");
    assert!((value - expected).abs() < 4e-15, "{value:e} {expected:e}");
}

#[test]
fn independent_draws_have_the_expected_level() {
    let reference_points = normal_points::<2>(4000, 6);
    let reference = EnergyReference::new(&Cloud::new(&reference_points).unwrap()).unwrap();
    assert!((reference.mean_distance() - std::f64::consts::PI.sqrt()).abs() < 0.03);
    let mean = mean_over_draws(64, 100..500, |cloud| reference.squared(cloud).unwrap());
    let ratio = mean / (reference.mean_distance() / 64.0);
    assert!((ratio - 1.0).abs() < 0.12, "{ratio}");
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let (points, other) = (normal_points::<3>(1000, 7), normal_points::<3>(777, 8));
    let (a, b) = (Cloud::new(&points).unwrap(), Cloud::new(&other).unwrap());
    let value = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| energy_distance_squared(&a, &b).unwrap()).to_bits()
    };
    assert_eq!(value(1), value(2));
    assert_eq!(value(1), value(5));
}

#[test]
fn bad_input_is_an_error() {
    let one = [[0.0, 0.0]];
    assert!(matches!(
        EnergyReference::new(&Cloud::new(&one).unwrap()),
        Err(MetricError::TooFewPoints { .. })
    ));
    let huge = [[1e200, 0.0], [-1e200, 0.0]];
    assert!(matches!(
        mean_pair_distance(&Cloud::new(&huge).unwrap()),
        Err(MetricError::Overflow { .. })
    ));
}

proptest! {
    #[test]
    fn rigid_motions_change_nothing_and_scale_is_linear(
        a in points_strategy::<2>(), b in points_strategy::<2>(), angle in 0.0..6.0f64, shift in -3.0..3.0f64,
        scale in 0.1..10.0f64,
    ) {
        let moved = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let (s, c) = angle.sin_cos();
            points.iter().map(|[x, y]| [scale * (c * x - s * y) + shift, scale * (s * x + c * y) - shift]).collect()
        };
        let value = energy_distance_squared(&Cloud::new(&a).unwrap(), &Cloud::new(&b).unwrap()).unwrap();
        let (a, b) = (moved(&a), moved(&b));
        let after = energy_distance_squared(&Cloud::new(&a).unwrap(), &Cloud::new(&b).unwrap()).unwrap();
        prop_assert!((after - scale * value).abs() < 1e-12);
    }
}
