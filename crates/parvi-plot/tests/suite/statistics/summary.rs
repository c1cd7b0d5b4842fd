//! Medians and quantiles.

use parvi_plot::statistics::{StatisticsError, summarize, weighted_quantile};

#[test]
fn the_median_is_in_the_middle() {
    let of = |values: &[f64]| {
        let summary = summarize(values).unwrap();
        [summary.minimum, summary.median, summary.maximum]
    };
    assert_eq!(of(&[4.0, 1.0, 3.0, 2.0]), [1.0, 2.5, 4.0]);
    assert_eq!(of(&[3.0, 1.0, 9.0]), [1.0, 3.0, 9.0]);
    assert_eq!(of(&[7.0]), [7.0; 3]);
}

#[test]
fn bad_samples_are_errors() {
    assert!(matches!(summarize(&[]), Err(StatisticsError::Empty { .. })));
    assert!(matches!(
        summarize(&[1.0, f64::NAN]),
        Err(StatisticsError::NotFinite { index: 1, .. })
    ));
}

#[test]
fn equal_weights_change_nothing() {
    let values = [3.0, 1.0, 2.0, 5.0];
    let levels = [0.0, 0.3, 0.5, 0.9, 1.0];
    assert_eq!(
        weighted_quantile(&values, None, &levels),
        weighted_quantile(&values, Some(&[2.0; 4]), &levels)
    );
    assert_eq!(weighted_quantile(&values, None, &[0.5]).unwrap(), [2.5]);
}

#[test]
fn levels_are_from_zero_to_one() {
    for level in [-0.1, 1.5, f64::NAN] {
        let refused = weighted_quantile(&[1.0, 2.0], None, &[0.5, level]);
        assert!(matches!(refused, Err(StatisticsError::Level { .. })), "{level}");
    }
}

#[test]
fn a_value_without_weight_does_not_count() {
    let quantiles = weighted_quantile(&[1.0, 100.0], Some(&[1.0, 0.0]), &[0.0, 0.5, 1.0]).unwrap();
    assert_eq!(quantiles, [1.0, 1.0, 1.0]);
    assert_eq!(
        weighted_quantile(&[1.0], Some(&[0.0]), &[0.5]),
        Err(StatisticsError::NoWeight)
    );
}
