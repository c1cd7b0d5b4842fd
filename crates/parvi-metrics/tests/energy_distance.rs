//! The energy distance against double sums written out, closed forms and invariances.

use parvi_metrics::{Cloud, EnergyReference, MetricError, energy_distance_squared, mean_pair_distance};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng, rngs::ChaCha12Rng};
use rand_distr::StandardNormal;

fn normal_points<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| std::array::from_fn(|_| rng.sample(StandardNormal)))
        .collect()
}

fn weights(count: usize, seed: u64) -> Vec<f64> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    (0..count).map(|_| rng.random_range(0.0..2.0)).collect()
}

/// E|x − y| as the definition has it.
fn naive_mean_distance<const D: usize>(a: &Cloud<'_, D>, b: &Cloud<'_, D>) -> f64 {
    let mut sum = 0.0;
    for (x, w) in a.iter() {
        sum += w * b
            .iter()
            .map(|(y, u)| u * (0..D).map(|k| (x[k] - y[k]).powi(2)).sum::<f64>().sqrt())
            .sum::<f64>();
    }
    sum
}

fn naive<const D: usize>(a: &Cloud<'_, D>, b: &Cloud<'_, D>) -> f64 {
    2.0 * naive_mean_distance(a, b) - naive_mean_distance(a, a) - naive_mean_distance(b, b)
}

fn agrees_with_the_definition<const D: usize>() {
    for (m, n) in [(1, 1), (1, 7), (8, 9), (127, 300), (513, 129)] {
        let (points, other) = (normal_points::<D>(m, 1), normal_points::<D>(n, 2));
        let (w, u) = (weights(m, 3), weights(n, 4));
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
    agrees_with_the_definition::<1>();
    agrees_with_the_definition::<2>();
    agrees_with_the_definition::<3>();
    agrees_with_the_definition::<6>();
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
    let (m, repetitions) = (64, 400);
    let mean = (0..repetitions)
        .map(|seed| {
            reference
                .squared(&Cloud::new(&normal_points::<2>(m, 100 + seed)).unwrap())
                .unwrap()
        })
        .sum::<f64>()
        / repetitions as f64;
    let ratio = mean / (reference.mean_distance() / m as f64);
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

fn points_strategy<const D: usize>() -> impl Strategy<Value = Vec<[f64; D]>> {
    prop::collection::vec(prop::array::uniform(-5.0..5.0f64), 1..40)
}

fn conformance<const D: usize>(a: &[[f64; D]], b: &[[f64; D]], counts: &[u8]) -> Result<(), TestCaseError> {
    let (plain, other) = (Cloud::new(a).unwrap(), Cloud::new(b).unwrap());
    let value = energy_distance_squared(&plain, &other).unwrap();
    prop_assert!(value > -1e-13);
    prop_assert!((value - energy_distance_squared(&other, &plain).unwrap()).abs() < 1e-13);
    prop_assert!(energy_distance_squared(&plain, &plain).unwrap().abs() < 1e-13);
    let equal = vec![0.3; a.len()];
    let weighted = Cloud::weighted(a, &equal).unwrap();
    prop_assert!((value - energy_distance_squared(&weighted, &other).unwrap()).abs() < 1e-13);
    let counts: Vec<f64> = (0..a.len()).map(|i| f64::from(counts[i % counts.len()])).collect();
    let repeated: Vec<[f64; D]> = a
        .iter()
        .zip(&counts)
        .flat_map(|(x, n)| std::iter::repeat_n(*x, *n as usize))
        .collect();
    if !repeated.is_empty() {
        let by_count = energy_distance_squared(&Cloud::weighted(a, &counts).unwrap(), &other).unwrap();
        let by_copy = energy_distance_squared(&Cloud::new(&repeated).unwrap(), &other).unwrap();
        prop_assert!((by_count - by_copy).abs() < 1e-13);
    }
    Ok(())
}

proptest! {
    #[test]
    fn weights_and_symmetry_in_one_dimension(
        a in points_strategy::<1>(), b in points_strategy::<1>(), counts in prop::collection::vec(0u8..4, 1..5),
    ) {
        conformance(&a, &b, &counts)?;
    }

    #[test]
    fn weights_and_symmetry_in_three_dimensions(
        a in points_strategy::<3>(), b in points_strategy::<3>(), counts in prop::collection::vec(0u8..4, 1..5),
    ) {
        conformance(&a, &b, &counts)?;
    }

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
