//! The width of kernel densities.

use parvi_plot::statistics::{StatisticsError, bandwidth};
use statrs::distribution::{ContinuousCDF, Normal};

/// n points at the quantiles of N(mean, sd²).
fn normal_points(count: usize, mean: f64, deviation: f64) -> Vec<f64> {
    let normal = Normal::new(mean, deviation).unwrap();
    (0..count)
        .map(|i| normal.inverse_cdf((i as f64 + 0.5) / count as f64))
        .collect()
}

#[test]
fn the_width_for_a_gaussian_is_near_the_best_one() {
    let points = normal_points(2000, 3.0, 2.0);
    let best = 1.06 * 2.0 * 2000f64.powf(-0.2);
    let width = bandwidth(&points, None).unwrap();
    assert!((0.75..1.15).contains(&(width / best)), "{width}");
}

#[test]
fn the_plug_in_rule_keeps_separated_modes_apart() {
    let mut points = normal_points(500, -4.0, 0.4);
    points.extend(normal_points(500, 4.0, 0.4));
    let plug_in = bandwidth(&points, None).unwrap();
    assert!((0.06..0.2).contains(&plug_in), "{plug_in}");
}

#[test]
fn weights_count_as_repetitions_of_the_distribution() {
    let points = normal_points(400, 0.0, 1.0);
    let equal = bandwidth(&points, Some(&[0.3; 400])).unwrap();
    let without = bandwidth(&points, None).unwrap();
    assert!((equal / without - 1.0).abs() < 1e-9);
}

#[test]
fn constant_values_have_no_width() {
    assert!(matches!(
        bandwidth(&[2.0; 5], None),
        Err(StatisticsError::NoSpread { .. })
    ));
}

/// Points in six heaps, as noise makes them: the smallest solution of the plug-in rule tells them apart.
#[test]
fn no_width_is_above_that_of_silvermans_rule() {
    let points = normal_points(1000, 0.0, 1.0);
    let silverman = 0.9 * 1000f64.powf(-0.2);
    let width = bandwidth(&points, None).unwrap();
    assert!((0.8..1.0001).contains(&(width / silverman)), "{width}");
}

#[test]
fn the_unit_of_the_values_is_that_of_the_width() {
    let points = normal_points(200, 0.5, 1.0);
    let width = bandwidth(&points, None).unwrap();
    for exponent in [-1000, -700, 700, 1000] {
        let unit = 2f64.powi(exponent);
        let scaled: Vec<f64> = points.iter().map(|x| unit * x).collect();
        assert_eq!(bandwidth(&scaled, None), Ok(unit * width), "{exponent}");
    }
    assert!(bandwidth(&[0.0; 3], None).is_err() && bandwidth(&[1e300; 3], None).is_err());
}
