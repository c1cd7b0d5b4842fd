//! What every metric has in common: equal weights are no weights, integer weights are copies, distances are symmetric,
//! zero between equal clouds, and blind to translation and, where they are isotropic, to rotation.

use crate::common::{copies, normal_points, points_strategy};
use mpm_tensor::Matrix;
use parvi_metrics::{
    Cloud, CloudMoments, Directions, DiscrepancyReference, EnergyReference, GaussianDiscrepancy, GaussianEnergy,
    InverseMultiquadric, ModeMasses, MomentError, RadialKernel, SlicedReference, energy_distance_squared,
    kernel_stein_discrepancy, maximum_mean_discrepancy_squared, mean_pair_distance, quantiles, sliced_wasserstein,
    wasserstein_1d,
};
use parvi_targets::{Mode, Moments};
use proptest::prelude::*;

const COVARIANCE: Matrix<3> = Matrix([[2.0, 0.5, 0.0], [0.5, 1.0, -0.2], [0.0, -0.2, 0.4]]);

fn directions() -> Directions<3> {
    Directions::evenly_spread(9).unwrap()
}

fn kernel() -> RadialKernel {
    RadialKernel::new(1.7).unwrap()
}

/// The symmetric distances between two clouds.
fn distances(a: &Cloud<'_, 3>, b: &Cloud<'_, 3>) -> Vec<(&'static str, f64)> {
    vec![
        ("energy", energy_distance_squared(a, b).unwrap()),
        ("sliced", sliced_wasserstein(a, b, &directions()).unwrap()),
        (
            "discrepancy",
            maximum_mean_discrepancy_squared(a, b, &kernel()).unwrap(),
        ),
    ]
}

fn line<'a>(points: &'a [[f64; 1]], weights: Option<&'a [f64]>) -> Cloud<'a, 1> {
    Cloud::with_optional_weights(points, weights).unwrap()
}

/// Every number that a cloud yields, against the fixed cloud `other` or by itself.
fn all_values(points: &[[f64; 3]], weights: Option<&[f64]>, other: &Cloud<'_, 3>) -> Vec<(&'static str, f64)> {
    let cloud = &Cloud::with_optional_weights(points, weights).unwrap();
    let mut values = distances(cloud, other);
    let scores: Vec<[f64; 3]> = points.iter().map(|x| [-x[0], 0.3 - 2.0 * x[1], x[0] - x[2]]).collect();
    let stein = |kernel| kernel_stein_discrepancy(cloud, &scores, &kernel).unwrap().squared;
    let moments = CloudMoments::new(cloud).unwrap();
    let reference = Moments {
        mean: [0.3, 0.0, -1.0],
        covariance: COVARIANCE,
    };
    let error = MomentError::new(cloud, &reference).unwrap();
    let mode = |x, mass| Mode {
        centre: [x, 0.0, 0.0],
        width: 1.0 + x.abs(),
        mass,
    };
    let masses = ModeMasses::new(cloud, &[mode(0.0, 0.25), mode(-2.0, 0.25), mode(3.0, 0.5)]).unwrap();
    values.extend([
        ("pairs", mean_pair_distance(cloud).unwrap()),
        (
            "energy reference",
            EnergyReference::new(other).unwrap().squared(cloud).unwrap(),
        ),
        (
            "energy Gaussian",
            GaussianEnergy::new([0.1; 3], &COVARIANCE)
                .unwrap()
                .squared(cloud)
                .unwrap(),
        ),
        (
            "sliced reference",
            SlicedReference::new(other, directions()).distance(cloud).unwrap(),
        ),
        (
            "discrepancy reference",
            DiscrepancyReference::new(other, kernel())
                .unwrap()
                .squared(cloud)
                .unwrap(),
        ),
        (
            "discrepancy Gaussian",
            GaussianDiscrepancy::new([0.1; 3], &COVARIANCE, kernel())
                .unwrap()
                .squared(cloud)
                .unwrap(),
        ),
        ("Stein", stein(InverseMultiquadric::default())),
        (
            "Stein, other exponent",
            stein(InverseMultiquadric::new(0.8, -0.3).unwrap()),
        ),
        ("mean", moments.mean[1]),
        ("covariance", moments.covariance.0[2][0]),
        ("mean error", error.largest_mean),
        ("deviation error", error.largest_standard_deviation),
        ("covariance error", error.largest_covariance),
        ("first mode", masses.masses[0]),
        ("mode error", masses.largest_error),
    ]);
    if moments.standard_deviation[0] > 1e-3 {
        values.extend([("skewness", moments.skewness[0]), ("kurtosis", moments.kurtosis[0])]);
    }
    if let Ok(kernel) = RadialKernel::median_heuristic(cloud) {
        values.push(("median", kernel.bandwidth()));
    }
    for level in [0.05, 0.31, 0.5, 0.97] {
        values.push(("quantile", quantiles(cloud, &[level]).unwrap()[0][2]));
    }
    let mine: Vec<[f64; 1]> = points.iter().map(|x| [x[0]]).collect();
    let theirs: Vec<[f64; 1]> = other.points().iter().map(|x| [x[0]]).collect();
    let (mine, theirs) = (line(&mine, weights), line(&theirs, other.weights()));
    for order in [1.0, 2.0, 3.0] {
        values.push(("Wasserstein", wasserstein_1d(&mine, &theirs, order).unwrap()));
    }
    values.extend([
        ("pairs on the line", mean_pair_distance(&mine).unwrap()),
        ("energy on the line", energy_distance_squared(&mine, &theirs).unwrap()),
        (
            "energy reference on the line",
            EnergyReference::new(&theirs).unwrap().squared(&mine).unwrap(),
        ),
        (
            "energy Gaussian on the line",
            GaussianEnergy::<1>::standard().unwrap().squared(&mine).unwrap(),
        ),
    ]);
    values
}

fn agree(a: &[(&str, f64)], b: &[(&str, f64)]) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.len(), b.len());
    for ((name, x), (_, y)) in a.iter().zip(b) {
        prop_assert!((x - y).abs() < 2e-12 * (1.0 + x.abs()), "{}: {} and {}", name, x, y);
    }
    Ok(())
}

proptest! {
    #[test]
    fn equal_weights_are_no_weights(a in points_strategy::<3>(), b in points_strategy::<3>(), weight in 1e-3..1e3f64) {
        let other = Cloud::new(&b).unwrap();
        agree(&all_values(&a, None, &other), &all_values(&a, Some(&vec![weight; a.len()]), &other))?;
        // The same for the reference, whose U-statistics know nothing of copies.
        let equal = vec![weight; b.len()];
        agree(&all_values(&a, None, &other), &all_values(&a, None, &Cloud::weighted(&b, &equal).unwrap()))?;
    }

    #[test]
    fn integer_weights_are_copies(
        a in points_strategy::<3>(), b in points_strategy::<3>(), counts in prop::collection::vec(0u8..4, 40),
    ) {
        let counts: Vec<f64> = counts[..a.len()].iter().map(|n| f64::from(*n)).collect();
        let copied = copies(&a, &counts);
        prop_assume!(!copied.is_empty());
        let other = Cloud::new(&b).unwrap();
        agree(&all_values(&copied, None, &other), &all_values(&a, Some(&counts), &other))?;
    }

    #[test]
    fn distances_are_symmetric_and_vanish_between_equal_clouds(
        a in points_strategy::<3>(), b in points_strategy::<3>(), weights in prop::collection::vec(0.1..3.0f64, 40),
    ) {
        let (first, second) = (Cloud::weighted(&a, &weights[..a.len()]).unwrap(), Cloud::new(&b).unwrap());
        let values = distances(&first, &second);
        for (name, value) in &values {
            prop_assert!(*value > -1e-13, "{} {}", name, value);
        }
        agree(&values, &distances(&second, &first))?;
        for (name, value) in distances(&first, &first) {
            prop_assert!(value.abs() < 1e-13, "{} {}", name, value);
        }
        // The same points in another order.
        let reversed: Vec<[f64; 3]> = a.iter().rev().copied().collect();
        let weights: Vec<f64> = weights[..a.len()].iter().rev().copied().collect();
        agree(&values, &distances(&Cloud::weighted(&reversed, &weights).unwrap(), &second))?;
    }

    #[test]
    fn translation_changes_no_distance(
        a in points_strategy::<3>(), b in points_strategy::<3>(), shift in prop::array::uniform3(-9.0..9.0f64),
    ) {
        let moved = |points: &[[f64; 3]]| -> Vec<[f64; 3]> {
            points.iter().map(|x| std::array::from_fn(|axis| x[axis] + shift[axis])).collect()
        };
        let before = distances(&Cloud::new(&a).unwrap(), &Cloud::new(&b).unwrap());
        agree(&before, &distances(&Cloud::new(&moved(&a)).unwrap(), &Cloud::new(&moved(&b)).unwrap()))?;
    }

    /// Isotropic metrics do not see a rotation; scores turn with the points.
    #[test]
    fn rotation_changes_no_isotropic_metric(
        a in points_strategy::<3>(), b in points_strategy::<3>(), angle in 0.0..6.0f64,
    ) {
        let (s, c) = angle.sin_cos();
        let turn = |points: &[[f64; 3]]| -> Vec<[f64; 3]> {
            points.iter().map(|[x, y, z]| [c * x - s * z, *y, s * x + c * z]).collect()
        };
        let values = |a: &[[f64; 3]], b: &[[f64; 3]], scores: &[[f64; 3]]| {
            let (a, b) = (Cloud::new(a).unwrap(), Cloud::new(b).unwrap());
            [
                ("energy", energy_distance_squared(&a, &b).unwrap()),
                ("discrepancy", maximum_mean_discrepancy_squared(&a, &b, &kernel()).unwrap()),
                ("Stein", kernel_stein_discrepancy(&a, scores, &InverseMultiquadric::default()).unwrap().squared),
                ("Gaussian", GaussianEnergy::<3>::standard().unwrap().squared(&a).unwrap()),
            ]
        };
        let scores: Vec<[f64; 3]> = a.iter().map(|x| [x[1] - x[0], 0.5, -2.0 * x[2]]).collect();
        agree(&values(&a, &b, &scores), &values(&turn(&a), &turn(&b), &turn(&scores)))?;
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let points = crate::common::normal_points::<3>(700, 1);
    let other = crate::common::normal_points::<3>(300, 2);
    let weights = crate::common::uniform_weights(700, 3);
    let values = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| all_values(&points, Some(&weights), &Cloud::new(&other).unwrap()))
    };
    let bits = |values: Vec<(&'static str, f64)>| values.iter().map(|value| value.1.to_bits()).collect::<Vec<_>>();
    let one = bits(values(1));
    assert_eq!(one, bits(values(2)));
    assert_eq!(one, bits(values(7)));
}

/// The same points in another order: the sums differ by rounding, of either sign.
#[test]
fn rounding_makes_no_distance_negative() {
    for count in [64, 257, 1000] {
        let points = normal_points::<3>(count, 11);
        let reversed: Vec<[f64; 3]> = points.iter().rev().copied().collect();
        let (cloud, other) = (Cloud::new(&points).unwrap(), Cloud::new(&reversed).unwrap());
        for second in [&cloud, &other] {
            for (name, value) in distances(&cloud, second) {
                assert!((0.0..1e-14).contains(&value), "{name} of {count}: {value:e}");
            }
        }
    }
}
