//! Powers through points.

use parvi_plot::statistics::{StatisticsError, fit_power_law, fit_power_law_of};

#[test]
fn an_exact_law_is_recovered_with_a_vanishing_interval() {
    let x: Vec<f64> = (0..8).map(|i| 100.0 * 2f64.powi(i)).collect();
    let y: Vec<f64> = x.iter().map(|x| 3e-8 * x.powf(1.25)).collect();
    let law = fit_power_law(&x, &y).unwrap();
    assert!((law.exponents[0].value - 1.25).abs() < 1e-12);
    assert!((law.prefactor / 3e-8 - 1.0).abs() < 1e-10);
    assert!(law.exponents[0].half_width.unwrap() < 1e-10);
    assert!((law.value(&[500.0]) / (3e-8 * 500f64.powf(1.25)) - 1.0).abs() < 1e-10);
}

/// log₁₀ y = 1, 2, 2, 3 at log₁₀ x = 0, 1, 2, 3: slope 0.6, residuals −0.1, 0.3, −0.3, 0.1 with RSS 0.2, so the standard
/// error is (0.2 / 2 / 5)^½ = 0.1414 and t₀.₉₇₅ with two degrees of freedom 4.3027.
#[test]
fn the_interval_is_students() {
    let law = fit_power_law(&[1.0, 10.0, 100.0, 1000.0], &[10.0, 100.0, 100.0, 1000.0]).unwrap();
    let exponent = law.exponents[0];
    assert!((exponent.value - 0.6).abs() < 1e-12);
    assert!((exponent.half_width.unwrap() - 4.302_653 * 0.02f64.sqrt()).abs() < 1e-5);
    assert!((law.r_squared - 0.9).abs() < 1e-12);
}

#[test]
fn two_predictors_separate() {
    let (mut m, mut d, mut time) = (vec![], vec![], vec![]);
    for dimension in 1..=6 {
        for exponent in 2..=5 {
            let particles = 10f64.powi(exponent);
            m.push(particles);
            d.push(f64::from(dimension));
            time.push(2e-8 * particles * f64::from(dimension).powf(1.7));
        }
    }
    let law = fit_power_law_of(&[&m, &d], &time).unwrap();
    assert!((law.exponents[0].value - 1.0).abs() < 1e-10);
    assert!((law.exponents[1].value - 1.7).abs() < 1e-10);
    assert!((law.r_squared - 1.0).abs() < 1e-12);
}

#[test]
fn two_points_give_a_slope_without_an_interval() {
    let law = fit_power_law(&[1.0, 10.0], &[1.0, 100.0]).unwrap();
    assert!((law.exponents[0].value - 2.0).abs() < 1e-12);
    assert_eq!(law.exponents[0].half_width, None);
}

#[test]
fn degenerate_data_are_errors() {
    assert!(matches!(fit_power_law(&[], &[]), Err(StatisticsError::Empty { .. })));
    assert!(matches!(
        fit_power_law(&[2.0, 2.0, 2.0], &[1.0, 2.0, 3.0]),
        Err(StatisticsError::Undetermined { .. })
    ));
    assert!(matches!(
        fit_power_law(&[1.0], &[1.0]),
        Err(StatisticsError::Undetermined { .. })
    ));
    assert!(matches!(
        fit_power_law(&[1.0, 2.0], &[1.0, 0.0]),
        Err(StatisticsError::NotPositive { index: 1, .. })
    ));
    assert!(matches!(
        fit_power_law_of(&[&[1.0, 2.0, 4.0], &[2.0, 4.0, 8.0]], &[1.0, 2.0, 3.0]),
        Err(StatisticsError::Undetermined { .. })
    ));
    assert!(matches!(
        fit_power_law(&[1.0, 2.0, 3.0], &[1.0, 2.0]),
        Err(StatisticsError::Length { .. })
    ));
}
