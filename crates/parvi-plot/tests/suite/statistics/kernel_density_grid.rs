//! Densities of pairs.

use std::f64::consts::PI;

use parvi_plot::statistics::{StatisticsError, kernel_density_grid};
use statrs::distribution::{ContinuousCDF, Normal};

/// Two independent standard normal coordinates from the additive recurrence with the plastic number.
fn normal_pairs(count: usize) -> (Vec<f64>, Vec<f64>) {
    let normal = Normal::new(0.0, 1.0).unwrap();
    let sequence = |step: f64| -> Vec<f64> {
        (0..count)
            .map(|i| normal.inverse_cdf((0.5 + step * (i + 1) as f64).fract()))
            .collect()
    };
    (sequence(0.754_877_666_246_693), sequence(0.569_840_290_998_053))
}

#[test]
fn a_correlated_cloud_keeps_its_correlation() {
    let (x, z) = normal_pairs(20_000);
    let slope = 0.99;
    let rest = (1.0f64 - slope * slope).sqrt();
    let y: Vec<f64> = x.iter().zip(&z).map(|(x, z)| slope * x + rest * z).collect();
    let grid = kernel_density_grid(&x, &y, None, ((-4.0, 4.0), (-4.0, 4.0)), 161).unwrap();
    let cell = 0.05f64.powi(2);
    let (mut mass, mut product, mut square) = (0.0, 0.0, 0.0);
    for (node, value) in grid.values.iter().enumerate() {
        let (x, y) = (grid.x[node % 161], grid.y[node / 161]);
        mass += value * cell;
        product += value * cell * x * y;
        square += value * cell * x * x;
    }
    assert!((mass - 1.0).abs() < 2e-3, "{mass}");
    assert!((product / square - slope).abs() < 2e-3);
    // The density across the ridge, whose width is 0.14.
    let peak = grid.values[80 * 161 + 80];
    assert!((peak * 2.0 * PI * rest - 1.0).abs() < 0.15, "{peak}");
}

#[test]
fn degenerate_clouds_are_errors() {
    let line = [0.0, 1.0, 2.0];
    let range = (0.0, 1.0);
    assert!(matches!(
        kernel_density_grid(&line, &line, None, (range, range), 20),
        Err(StatisticsError::NoSpread { .. })
    ));
    assert!(matches!(
        kernel_density_grid(&line, &[1.0, 2.0, 0.0], None, ((1.0, 1.0), range), 20),
        Err(StatisticsError::Interval { .. })
    ));
}
