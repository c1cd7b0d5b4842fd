//! The maximum mean discrepancy against double sums, sampled references and its i.i.d. level.

use crate::common::{double_sum, mean_over_draws, normal_points, squared_distance, uniform_weights};
use mpm_tensor::Matrix;
use parvi_metrics::{
    Cloud, DiscrepancyReference, GaussianDiscrepancy, MetricError, RadialKernel, maximum_mean_discrepancy_squared,
};

#[test]
fn agrees_with_the_definition() {
    for (m, n) in [(2, 3), (130, 257)] {
        let (points, other) = (normal_points::<4>(m, 1), normal_points::<4>(n, 2));
        let (w, u) = (uniform_weights(m, 3), uniform_weights(n, 4));
        let (a, b) = (
            Cloud::weighted(&points, &w).unwrap(),
            Cloud::weighted(&other, &u).unwrap(),
        );
        for bandwidth in [0.2, 1.0, 30.0] {
            let kernel = RadialKernel::new(bandwidth).unwrap();
            let k = |x: &[f64; 4], y: &[f64; 4]| (-0.5 * squared_distance(x, y) / (bandwidth * bandwidth)).exp();
            let own = double_sum(&b, &b, k);
            let rest = double_sum(&a, &a, k) - 2.0 * double_sum(&a, &b, k);
            let value = maximum_mean_discrepancy_squared(&a, &b, &kernel).unwrap();
            assert!((value - (rest + own)).abs() < 1e-13, "{value}");
            let squares = b.iter().map(|(_, u)| u * u).sum::<f64>();
            let reference = DiscrepancyReference::new(&b, kernel).unwrap();
            let unbiased = (own - squares) / (1.0 - squares);
            assert!((reference.mean_kernel() - unbiased).abs() < 1e-13);
            assert!((reference.squared(&a).unwrap() - (rest + unbiased)).abs() < 1e-13);
        }
    }
}

/// E k(x, Y) and E k(Y, Y') on the line, by the trapezoidal rule.
#[test]
fn gaussian_expectations_agree_with_integrals() {
    let (mean, variance, bandwidth) = (0.7, 2.3f64, 0.9);
    let kernel = RadialKernel::new(bandwidth).unwrap();
    let exact = GaussianDiscrepancy::new([mean], &Matrix([[variance]]), kernel).unwrap();
    let density =
        |y: f64, variance: f64| (-0.5 * y * y / variance).exp() / (2.0 * std::f64::consts::PI * variance).sqrt();
    let k = |r: f64| (-0.5 * r * r / (bandwidth * bandwidth)).exp();
    let integral = |f: &dyn Fn(f64) -> f64| (-4000..4000).map(|i| f(f64::from(i) * 0.01) * 0.01).sum::<f64>();
    for x in [-2.0, 0.7, 5.0] {
        let expected = integral(&|y| density(y - mean, variance) * k(x - y));
        assert!((exact.expected_kernel(&[x]) - expected).abs() < 1e-14);
    }
    let expected = integral(&|y| density(y, 2.0 * variance) * k(y));
    assert!((exact.mean_kernel() - expected).abs() < 1e-14);
}

#[test]
fn exact_and_sampled_references_agree() {
    let draws: Vec<[f64; 2]> = normal_points::<2>(5000, 1)
        .iter()
        .map(|z| [2.0 * z[0], 2.0 * z[0] + z[1]])
        .collect();
    let reference = Cloud::new(&draws).unwrap();
    let kernel = RadialKernel::median_heuristic(&reference).unwrap();
    let exact = GaussianDiscrepancy::new([0.0; 2], &Matrix([[4.0, 4.0], [4.0, 5.0]]), kernel).unwrap();
    let sampled = DiscrepancyReference::new(&reference, kernel).unwrap();
    assert!((exact.mean_kernel() - sampled.mean_kernel()).abs() < 0.01);
    let points = normal_points::<2>(100, 2);
    let cloud = Cloud::new(&points).unwrap();
    let (a, b) = (exact.squared(&cloud).unwrap(), sampled.squared(&cloud).unwrap());
    assert!(a > 0.02 && (a - b).abs() < 0.1 * a, "{a} {b}");
}

#[test]
fn independent_draws_have_the_expected_level() {
    let kernel = RadialKernel::new(1.2).unwrap();
    let exact = GaussianDiscrepancy::<2>::new([0.0; 2], &Matrix::diagonal(&[1.0; 2]), kernel).unwrap();
    let mean = mean_over_draws(50, 10..510, |cloud| exact.squared(cloud).unwrap());
    let ratio = mean / ((1.0 - exact.mean_kernel()) / 50.0);
    assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
}

#[test]
fn median_bandwidth() {
    let points = [[0.0], [1.0], [4.0]];
    assert_eq!(
        RadialKernel::median_heuristic(&Cloud::new(&points).unwrap())
            .unwrap()
            .bandwidth(),
        3.0
    );
    // The median distance of two standard normal draws is √2 Φ⁻¹(¾); 5000 points are thinned.
    let many = normal_points::<1>(5000, 3);
    let bandwidth = RadialKernel::median_heuristic(&Cloud::new(&many).unwrap())
        .unwrap()
        .bandwidth();
    assert!((bandwidth / 0.953_873 - 1.0).abs() < 0.05, "{bandwidth}");
    // Thinning follows the weights: all of the weight on the second half.
    let weights: Vec<f64> = (0..5000).map(|i| f64::from(u8::from(i >= 2500))).collect();
    let half = RadialKernel::median_heuristic(&Cloud::weighted(&many, &weights).unwrap()).unwrap();
    assert!((half.bandwidth() / 0.953_873 - 1.0).abs() < 0.07);
}

#[test]
fn bad_input_is_an_error() {
    for bandwidth in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            RadialKernel::new(bandwidth),
            Err(MetricError::InvalidParameter { .. })
        ));
    }
    let same = Cloud::new(&[[1.0], [1.0]]).unwrap();
    assert!(matches!(
        RadialKernel::median_heuristic(&same),
        Err(MetricError::TooFewPoints { .. })
    ));
    let far = [[0.0, 0.0], [1e200, 0.0]];
    assert!(matches!(
        RadialKernel::median_heuristic(&Cloud::new(&far).unwrap()),
        Err(MetricError::Overflow { .. })
    ));
    let one = Cloud::new(&[[1.0]]).unwrap();
    let kernel = RadialKernel::new(1.0).unwrap();
    assert!(matches!(
        DiscrepancyReference::new(&one, kernel),
        Err(MetricError::TooFewPoints { .. })
    ));
}
