//! The energy distance from a Gaussian against known values, sampled references and its i.i.d. level.

use crate::common::{mean_over_draws, normal_points};
use mpm_tensor::Matrix;
use parvi_metrics::{Cloud, EnergyReference, GaussianEnergy, MetricError};

#[test]
fn mean_distances_of_standard_gaussians() {
    let close = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 4e-15, "{value} {expected}");
    let pi = std::f64::consts::PI;
    close(
        GaussianEnergy::<1>::standard().unwrap().mean_distance(),
        2.0 / pi.sqrt(),
    );
    close(GaussianEnergy::<2>::standard().unwrap().mean_distance(), pi.sqrt());
    close(
        GaussianEnergy::<3>::standard().unwrap().mean_distance(),
        4.0 / pi.sqrt(),
    );
    close(
        GaussianEnergy::<4>::standard().unwrap().mean_distance(),
        1.5 * pi.sqrt(),
    );
    close(
        GaussianEnergy::<6>::standard().unwrap().mean_distance(),
        1.875 * pi.sqrt(),
    );
}

/// One particle at the mean: ED² = 2 E‖Y − m‖ − E‖Y − Y'‖ = (2 − √2) E‖Y − m‖, whatever the covariance.
#[test]
fn one_particle_at_the_mean() {
    let covariance = Matrix([[2.0, 0.9, 0.0], [0.9, 1.0, -0.3], [0.0, -0.3, 0.5]]);
    let mean = [5.0, -3.0, 100.0];
    let energy = GaussianEnergy::new(mean, &covariance).unwrap();
    let value = energy.squared(&Cloud::new(&[mean]).unwrap()).unwrap();
    let expected = (std::f64::consts::SQRT_2 - 1.0) * energy.mean_distance();
    assert!((value / expected - 1.0).abs() < 1e-14);
}

fn independent_draws<const D: usize>(particles: usize, repetitions: u64) {
    let energy = GaussianEnergy::<D>::standard().unwrap();
    let seeds = 1000..1000 + repetitions;
    let mean = mean_over_draws(particles, seeds, |cloud| energy.squared(cloud).unwrap());
    let ratio = mean / (energy.mean_distance() / particles as f64);
    assert!((ratio - 1.0).abs() < 0.12, "d = {D}: {ratio}");
}

#[test]
fn independent_draws_have_the_expected_level() {
    independent_draws::<1>(64, 600);
    independent_draws::<2>(64, 400);
    independent_draws::<6>(64, 200);
}

/// A correlated Gaussian from its own linear map, and a sampled reference of it: they agree to the reference's noise.
#[test]
fn agrees_with_a_sampled_reference() {
    let lower = [[2.0, 0.0], [1.5, 0.4]];
    let mean = [1.0, -2.0];
    let map = |z: &[f64; 2]| {
        [
            mean[0] + lower[0][0] * z[0],
            mean[1] + lower[1][0] * z[0] + lower[1][1] * z[1],
        ]
    };
    let covariance = Matrix([[4.0, 3.0], [3.0, 2.25 + 0.16]]);
    let draws: Vec<[f64; 2]> = normal_points::<2>(20_000, 1).iter().map(map).collect();
    let reference = EnergyReference::new(&Cloud::new(&draws).unwrap()).unwrap();
    let exact = GaussianEnergy::new(mean, &covariance).unwrap();
    assert!((reference.mean_distance() / exact.mean_distance() - 1.0).abs() < 0.02);
    let particles: Vec<[f64; 2]> = normal_points::<2>(200, 2)
        .iter()
        .map(|z| map(&[1.3 * z[0] + 0.2, z[1]]))
        .collect();
    let weights: Vec<f64> = (0..200).map(|i| 1.0 + f64::from(i % 3)).collect();
    for cloud in [
        Cloud::new(&particles).unwrap(),
        Cloud::weighted(&particles, &weights).unwrap(),
    ] {
        let (sampled, integrated) = (reference.squared(&cloud).unwrap(), exact.squared(&cloud).unwrap());
        assert!(
            integrated > 0.02 && (sampled - integrated).abs() < 0.15 * integrated,
            "{sampled} {integrated}"
        );
    }
}

/// Rotating, shifting and scaling cloud and Gaussian together.
#[test]
fn rigid_motions_change_nothing_and_scale_is_linear() {
    let points = normal_points::<2>(50, 3);
    let before = GaussianEnergy::new([0.3, 0.1], &Matrix::diagonal(&[2.0, 0.1])).unwrap();
    let value = before.squared(&Cloud::new(&points).unwrap()).unwrap();
    for (angle, scale, shift) in [(0.0, 1.0, 50.0), (0.7, 1.0, 0.0), (2.0, 30.0, -4.0)] {
        let (s, c) = f64::sin_cos(angle);
        let rotation = Matrix([[c, -s], [s, c]]);
        let move_point = |point: &[f64; 2]| rotation.apply(point).map(|x| scale * x + shift);
        let covariance = rotation * Matrix::diagonal(&[2.0, 0.1]) * rotation.transpose() * (scale * scale);
        let after = GaussianEnergy::new(move_point(&[0.3, 0.1]), &covariance.symmetric_part()).unwrap();
        let moved: Vec<[f64; 2]> = points.iter().map(move_point).collect();
        let moved = after.squared(&Cloud::new(&moved).unwrap()).unwrap() / scale;
        assert!(
            (moved - value).abs() < 1e-13,
            "{angle} {scale} {shift}: {moved} {value}"
        );
    }
}

#[test]
fn weights_behave_as_copies() {
    let points = normal_points::<3>(6, 4);
    let energy = GaussianEnergy::<3>::standard().unwrap();
    let value = |points: &[[f64; 3]], weights| {
        energy
            .squared(&Cloud::with_optional_weights(points, weights).unwrap())
            .unwrap()
    };
    let plain = value(&points, None);
    assert!((plain - value(&points, Some(&[0.7; 6]))).abs() < 1e-14);
    let copies = [points[0], points[0], points[1], points[4], points[4], points[4]];
    assert!((value(&copies, None) - value(&points, Some(&[2.0, 1.0, 0.0, 0.0, 3.0, 0.0]))).abs() < 1e-14);
}

#[test]
fn bad_covariances_are_errors() {
    let error = |matrix| GaussianEnergy::new([0.0; 2], &Matrix(matrix)).unwrap_err();
    assert!(matches!(
        error([[1.0, 0.5], [0.4, 1.0]]),
        MetricError::InvalidCovariance { .. }
    ));
    assert!(matches!(
        error([[1.0, 2.0], [2.0, 1.0]]),
        MetricError::InvalidCovariance { value: -1.0, .. }
    ));
    assert!(matches!(
        error([[1.0, f64::NAN], [f64::NAN, 1.0]]),
        MetricError::InvalidCovariance { .. }
    ));
    let error = GaussianEnergy::new([f64::NAN], &Matrix([[1.0]])).unwrap_err();
    assert!(matches!(
        error,
        MetricError::InvalidEntry {
            name: "mean",
            index: 0,
            ..
        }
    ));
}
