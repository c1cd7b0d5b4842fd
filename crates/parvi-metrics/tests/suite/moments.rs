//! Moments, quantiles, mode masses and standardised coordinates against small cases by hand and their i.i.d. level.

use crate::common::{normal_points, uniform_weights};
use mpm_tensor::Matrix;
use parvi_metrics::{Cloud, CloudMoments, MetricError, ModeMasses, MomentError, Standardiser, quantiles};
use parvi_targets::{Mode, Moments};
use proptest::prelude::*;

#[test]
fn a_small_case_by_hand() {
    let points = [[0.0, 1.0], [1.0, 1.0], [5.0, -1.0]];
    let moments = CloudMoments::new(&Cloud::weighted(&points, &[1.0, 2.0, 1.0]).unwrap()).unwrap();
    assert_eq!(moments.mean, [1.75, 0.5]);
    let variance = (1.75f64.powi(2) + 2.0 * 0.75f64.powi(2) + 3.25f64.powi(2)) / 4.0;
    assert!((moments.covariance.0[0][0] - variance).abs() < 1e-15);
    assert!((moments.covariance.0[0][1] + 1.625).abs() < 1e-15);
    assert_eq!(moments.covariance.0[0][1], moments.covariance.0[1][0]);
    assert!((moments.standard_deviation[1] - 0.75f64.sqrt()).abs() < 1e-15);
    let third = (-(1.75f64.powi(3)) - 2.0 * 0.75f64.powi(3) + 3.25f64.powi(3)) / 4.0;
    assert!((moments.skewness[0] - third / variance.powf(1.5)).abs() < 1e-14);
    let fourth = (3.0 * 0.5f64.powi(4) + 1.5f64.powi(4)) / 4.0;
    assert!((moments.kurtosis[1] - fourth / 0.5625).abs() < 1e-14);
    assert!(CloudMoments::new(&Cloud::new(&[[1.0]]).unwrap()).unwrap().skewness[0].is_nan());
}

/// The weighted sum of equal numbers is not always that number.
#[test]
fn an_axis_without_spread_has_none_to_rounding() {
    for value in [-0.185_172_028_205_449_65, 1_000_000.676_659_944_2, 0.1] {
        for count in [3, 5, 65] {
            let points = vec![[value]; count];
            let moments = CloudMoments::new(&Cloud::new(&points).unwrap()).unwrap();
            assert_eq!((moments.mean[0], moments.covariance.0[0][0]), (value, 0.0));
            assert!(moments.skewness[0].is_nan() && moments.kurtosis[0].is_nan());
        }
    }
}

#[test]
fn the_outermost_quantiles_are_the_outermost_points_of_any_weight() {
    let points = [[-9.0], [0.0], [1.0], [9.0]];
    let weights = [1e-13, 1.0, 1.0, 1e-13];
    let found = quantiles(&Cloud::weighted(&points, &weights).unwrap(), &[0.0, 0.5, 1.0]).unwrap();
    assert_eq!(found, [[-9.0], [0.5], [9.0]]);
}

/// As in the headers of files, x1 is the first axis.
#[test]
fn messages_count_axes_from_one() {
    let error = Cloud::new(&[[0.0, f64::NAN]]).unwrap_err();
    assert!(error.to_string().contains("x2 = NaN"), "{error}");
}

/// A large offset must not cost digits of the covariance.
#[test]
fn offsets_do_not_cancel() {
    let points = normal_points::<2>(1000, 1);
    let far: Vec<[f64; 2]> = points.iter().map(|x| x.map(|x| x + 1048576.0)).collect();
    let near: Vec<[f64; 2]> = far.iter().map(|x| x.map(|x| x - 1048576.0)).collect();
    let a = CloudMoments::new(&Cloud::new(&far).unwrap()).unwrap();
    let b = CloudMoments::new(&Cloud::new(&near).unwrap()).unwrap();
    assert!((a.covariance - b.covariance).maximum_norm() < 1e-14);
}

#[test]
fn quantiles_by_hand() {
    let points = [[4.0], [1.0], [3.0], [2.0]];
    let levels = [0.0, 0.1, 0.25, 0.3, 0.5, 0.75, 0.9, 1.0];
    let values: Vec<f64> = quantiles(&Cloud::new(&points).unwrap(), &levels)
        .unwrap()
        .iter()
        .map(|q| q[0])
        .collect();
    assert_eq!(values, [1.0, 1.0, 1.5, 2.0, 2.5, 3.5, 4.0, 4.0]);
    let weighted = Cloud::weighted(&points, &[0.0, 7.0, 1.0, 2.0]).unwrap();
    let values: Vec<f64> = quantiles(&weighted, &[0.5, 0.7, 0.85, 0.95, 1.0])
        .unwrap()
        .iter()
        .map(|q| q[0])
        .collect();
    assert_eq!(values, [1.0, 1.5, 2.0, 3.0, 3.0]);
    let error = quantiles(&weighted, &[0.5, 1.5]).unwrap_err();
    assert!(matches!(
        error,
        MetricError::InvalidEntry {
            index: 1,
            value: 1.5,
            ..
        }
    ));
}

#[test]
fn errors_are_in_reference_deviations() {
    let reference = Moments {
        mean: [1.0, 0.0],
        covariance: Matrix([[4.0, 0.5], [0.5, 0.25]]),
    };
    // Mean (2, 0.1), variances 9 and 0.01, covariance 0.
    let points = [[5.0, 0.2], [-1.0, 0.2], [5.0, 0.0], [-1.0, 0.0]];
    let error = MomentError::new(&Cloud::new(&points).unwrap(), &reference).unwrap();
    for (value, expected) in [
        (error.mean[0], 0.5),
        (error.mean[1], 0.2),
        (error.standard_deviation[0], 0.5),
        (error.standard_deviation[1], -0.8),
        (error.largest_mean, 0.5),
        (error.largest_standard_deviation, 0.8),
        (error.largest_covariance, 1.25),
    ] {
        assert!((value - expected).abs() < 1e-14, "{value} {expected}");
    }
    let flat = Moments {
        mean: [0.0; 2],
        covariance: Matrix([[1.0, 0.0], [0.0, 0.0]]),
    };
    let error = MomentError::new(&Cloud::new(&points).unwrap(), &flat).unwrap_err();
    assert!(matches!(error, MetricError::InvalidCovariance { value: 0.0, .. }));
}

#[test]
fn independent_draws_have_the_expected_level() {
    let reference = Moments {
        mean: [0.0; 2],
        covariance: Matrix::diagonal(&[1.0; 2]),
    };
    let (m, repetitions) = (200, 400);
    let (mut mean, mut deviation) = (0.0, 0.0);
    for seed in 0..repetitions {
        let points = normal_points::<2>(m, 10 + seed);
        let error = MomentError::new(&Cloud::new(&points).unwrap(), &reference).unwrap();
        mean += error.mean[0].powi(2) / repetitions as f64;
        deviation += error.standard_deviation[1].powi(2) / repetitions as f64;
    }
    assert!((mean * m as f64 - 1.0).abs() < 0.25, "{mean}");
    assert!((deviation * 2.0 * m as f64 - 1.0).abs() < 0.25, "{deviation}");
}

fn mode(centre: [f64; 2], width: f64, mass: f64) -> Mode<2> {
    Mode { centre, width, mass }
}

#[test]
fn points_belong_to_the_nearest_mode_in_units_of_its_width() {
    let modes = [mode([0.0, 0.0], 1.0, 0.25), mode([4.0, 0.0], 3.0, 0.75)];
    // (1.5, 0) is nearer to the first centre, but 1.5 widths off; the second is 2.5/3 widths off.
    let points = [[1.5, 0.0], [0.5, 0.0], [9.0, 1.0], [-1.0, 0.0]];
    let result = ModeMasses::new(&Cloud::new(&points).unwrap(), &modes).unwrap();
    assert_eq!(result.masses, [0.5, 0.5]);
    assert_eq!(result.true_masses, [0.25, 0.75]);
    assert_eq!(result.largest_error, 0.25);
    assert!((result.standard_errors[0] - (0.1875f64 / 4.0).sqrt()).abs() < 1e-15);
    let weighted = ModeMasses::new(&Cloud::weighted(&points, &[1.0, 0.0, 6.0, 1.0]).unwrap(), &modes).unwrap();
    assert_eq!(weighted.masses, [0.125, 0.875]);
    // The effective sample size of these weights is 64/38.
    assert!((weighted.standard_errors[1] - (0.1875f64 * 38.0 / 64.0).sqrt()).abs() < 1e-15);
}

#[test]
fn mode_masses_of_random_draws_stay_within_their_standard_error() {
    let modes = [mode([-5.0, 0.0], 1.0, 0.3), mode([5.0, 0.0], 1.0, 0.7)];
    let (m, repetitions) = (100, 400);
    let mut scaled = 0.0;
    for seed in 0..repetitions {
        let uniform = uniform_weights(m, 50 + seed);
        let points: Vec<[f64; 2]> = normal_points::<2>(m, 900 + seed)
            .iter()
            .zip(&uniform)
            .map(|(z, u)| [z[0] + if *u < 0.6 { -5.0 } else { 5.0 }, z[1]])
            .collect();
        let result = ModeMasses::new(&Cloud::new(&points).unwrap(), &modes).unwrap();
        scaled += ((result.masses[0] - 0.3) / result.standard_errors[0]).powi(2) / repetitions as f64;
    }
    assert!((scaled - 1.0).abs() < 0.25, "{scaled}");
}

#[test]
fn bad_modes_are_named() {
    let cloud = Cloud::new(&[[0.0, 0.0]]).unwrap();
    assert_eq!(ModeMasses::new(&cloud, &[]).unwrap_err(), MetricError::NoModes);
    let good = mode([0.0; 2], 1.0, 1.0);
    for bad in [
        mode([0.0; 2], 0.0, 0.5),
        mode([0.0; 2], 1.0, -0.5),
        mode([f64::NAN, 0.0], 1.0, 0.5),
    ] {
        let error = ModeMasses::new(&cloud, &[good, bad]).unwrap_err();
        assert!(matches!(error, MetricError::InvalidEntry { index: 1, .. }), "{error}");
    }
}

proptest! {
    /// Whitened by its own moments, a cloud has mean 0 and covariance I; per axis, unit variances.
    #[test]
    fn standardised_clouds_have_unit_moments(a in prop::collection::vec(prop::array::uniform3(-5.0..5.0f64), 12..40)) {
        let moments = CloudMoments::new(&Cloud::new(&a).unwrap()).unwrap().moments();
        let whitened = Standardiser::whitening(&moments).unwrap();
        let points = whitened.points(&a);
        let result = CloudMoments::new(&Cloud::new(&points).unwrap()).unwrap();
        let identity = Matrix::diagonal(&[1.0; 3]);
        prop_assert!((result.covariance - identity).maximum_norm() < 1e-10);
        prop_assert!(result.mean.iter().all(|m| m.abs() < 1e-11));
        for (x, z) in a.iter().zip(&points) {
            let back = whitened.original(z);
            prop_assert!((0..3).all(|axis| (back[axis] - x[axis]).abs() < 1e-12));
        }
        let points = Standardiser::per_axis(&moments).unwrap().points(&a);
        let result = CloudMoments::new(&Cloud::new(&points).unwrap()).unwrap();
        for i in 0..3 {
            prop_assert!((result.covariance.0[i][i] - 1.0).abs() < 1e-12);
            let correlation = moments.covariance.0[i][0]
                / (moments.covariance.0[i][i] * moments.covariance.0[0][0]).sqrt();
            prop_assert!((result.covariance.0[i][0] - correlation).abs() < 1e-12);
        }
    }
}

#[test]
fn an_indefinite_covariance_cannot_whiten() {
    let moments = Moments {
        mean: [0.0; 2],
        covariance: Matrix([[1.0, 2.0], [2.0, 1.0]]),
    };
    assert!(matches!(
        Standardiser::whitening(&moments),
        Err(MetricError::InvalidCovariance { value: -3.0, .. })
    ));
    assert!(Standardiser::per_axis(&moments).is_ok());
    let error = Standardiser::per_axis(&Moments {
        mean: [0.0, f64::NAN],
        ..moments
    })
    .unwrap_err();
    assert!(matches!(error, MetricError::InvalidEntry { index: 1, .. }));
}
