//! The kernel Stein discrepancy against its definition, written with derivatives of the kernel, and its level for exact
//! draws.

use crate::common::{normal_points, uniform_weights};
use parvi_metrics::{
    Cloud, InverseMultiquadric, MetricError, Standardiser, kernel_stein_discrepancy, target_stein_discrepancy,
};
use parvi_targets::{Moments, Target};

struct StandardNormal;

impl<const D: usize> Target<D> for StandardNormal {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        -0.5 * x.iter().map(|x| x * x).sum::<f64>()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        x.map(|x| -x)
    }
}

/// u(x, y) from central differences of the kernel.
fn stein_kernel<const D: usize>(
    (x, sx): (&[f64; D], &[f64; D]),
    (y, sy): (&[f64; D], &[f64; D]),
    (c, beta): (f64, f64),
) -> f64 {
    let kernel = |x: &[f64; D], y: &[f64; D]| (c * c + crate::common::squared_distance(x, y)).powf(beta);
    let step = 1e-4;
    let shifted = |x: &[f64; D], axis: usize, sign: f64| {
        let mut x = *x;
        x[axis] += sign * step;
        x
    };
    let mut value = 0.0;
    for k in 0..D {
        let by_x = |y: &[f64; D]| (kernel(&shifted(x, k, 1.0), y) - kernel(&shifted(x, k, -1.0), y)) / (2.0 * step);
        let by_y = (kernel(x, &shifted(y, k, 1.0)) - kernel(x, &shifted(y, k, -1.0))) / (2.0 * step);
        let mixed = (by_x(&shifted(y, k, 1.0)) - by_x(&shifted(y, k, -1.0))) / (2.0 * step);
        value += sx[k] * sy[k] * kernel(x, y) + sx[k] * by_y + sy[k] * by_x(y) + mixed;
    }
    value
}

fn agrees_with_the_definition<const D: usize>() {
    let points = normal_points::<D>(19, 1);
    let scores = normal_points::<D>(19, 2);
    let weights = uniform_weights(19, 3);
    let cloud = Cloud::weighted(&points, &weights).unwrap();
    for (c, beta) in [(1.0, -0.5), (0.7, -0.5), (1.3, -0.2)] {
        let kernel = InverseMultiquadric::new(c, beta).unwrap();
        let value = kernel_stein_discrepancy(&cloud, &scores, &kernel).unwrap();
        let (mut all, mut distinct, mut share) = (0.0, 0.0, 0.0);
        for i in 0..19 {
            for j in 0..19 {
                let product = cloud.weight(i) * cloud.weight(j);
                let u = stein_kernel((&points[i], &scores[i]), (&points[j], &scores[j]), (c, beta));
                all += product * u;
                if i != j {
                    distinct += product * u;
                    share += product;
                }
            }
        }
        assert!(
            (value.squared - all).abs() < 1e-6,
            "{D} {c} {beta}: {} {all}",
            value.squared
        );
        assert!((value.unbiased_squared.unwrap() - distinct / share).abs() < 1e-6);
        assert!((value.discrepancy() - value.squared.sqrt()).abs() < 1e-15);
    }
}

#[test]
fn agrees_with_the_definition_in_every_dimension() {
    mpm_tensor::in_dimensions!(agrees_with_the_definition(), 1, 2, 5);
}

/// Exact draws from N(0, I), c = 1: E KSD² = E u(x, x)/M = (E|s|² + d)/M = 2d/M, and the U-statistic has mean zero.
#[test]
fn independent_draws_have_the_expected_level() {
    const D: usize = 3;
    let (m, repetitions) = (64, 400);
    let (mut biased, mut unbiased, mut squares) = (0.0, 0.0, 0.0);
    for seed in 0..repetitions {
        let points = normal_points::<D>(m, 100 + seed);
        let kernel = InverseMultiquadric::default();
        let value = target_stein_discrepancy(&Cloud::new(&points).unwrap(), &StandardNormal, &kernel).unwrap();
        let unbiased_squared = value.unbiased_squared.unwrap();
        biased += value.squared / repetitions as f64;
        unbiased += unbiased_squared / repetitions as f64;
        squares += unbiased_squared * unbiased_squared / repetitions as f64;
    }
    let ratio = biased / (2.0 * D as f64 / m as f64);
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    let error = (squares / repetitions as f64).sqrt();
    assert!(unbiased.abs() < 4.0 * error, "{unbiased} {error}");
}

#[test]
fn a_wrong_mean_is_seen() {
    let value = |shift: f64| {
        let points: Vec<[f64; 2]> = normal_points::<2>(500, 7)
            .iter()
            .map(|x| [x[0] + shift, x[1]])
            .collect();
        let cloud = Cloud::new(&points).unwrap();
        target_stein_discrepancy(&cloud, &StandardNormal, &InverseMultiquadric::default())
            .unwrap()
            .squared
    };
    assert!(value(0.5) > 5.0 * value(0.0));
}

/// In standardised coordinates N(m, C) is N(0, I), points and scores alike.
#[test]
fn scores_are_standardised_with_the_points() {
    let moments = Moments {
        mean: [3.0, -1.0],
        covariance: mpm_tensor::Matrix([[4.0, 1.0], [1.0, 0.5]]),
    };
    let precision = moments.covariance.inverse().unwrap();
    let standardiser = Standardiser::whitening(&moments).unwrap();
    for z in normal_points::<2>(20, 8) {
        let x = standardiser.original(&z);
        let score = precision.apply(&[moments.mean[0] - x[0], moments.mean[1] - x[1]]);
        let (back, score) = (standardiser.point(&x), standardiser.score(&score));
        for axis in 0..2 {
            assert!((back[axis] - z[axis]).abs() < 1e-13 && (score[axis] + z[axis]).abs() < 1e-13);
        }
    }
}

#[test]
fn bad_input_is_named() {
    let points = [[0.0, 1.0], [2.0, 3.0]];
    let cloud = Cloud::new(&points).unwrap();
    let kernel = InverseMultiquadric::default();
    let error = kernel_stein_discrepancy(&cloud, &[[0.0; 2]], &kernel).unwrap_err();
    assert_eq!(
        error,
        MetricError::LengthMismatch {
            name: "scores",
            points: 2,
            given: 1
        }
    );
    let error = kernel_stein_discrepancy(&cloud, &[[0.0; 2], [0.0, f64::NAN]], &kernel).unwrap_err();
    assert!(matches!(error, MetricError::NonFiniteScore { index: 1, axis: 1, .. }));
    let error = kernel_stein_discrepancy(&cloud, &[[1e200; 2]; 2], &kernel).unwrap_err();
    assert!(matches!(error, MetricError::Overflow { .. }));
    // Squares of the last two are no numbers to divide by.
    for offset in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e200, 1e-200] {
        assert!(InverseMultiquadric::new(offset, -0.5).is_err(), "{offset}");
    }
    assert!(InverseMultiquadric::new(1.0, 0.5).is_err());
    let one = Cloud::new(&points[..1]).unwrap();
    assert_eq!(
        kernel_stein_discrepancy(&one, &[[0.0; 2]], &kernel)
            .unwrap()
            .unbiased_squared,
        None
    );
}
