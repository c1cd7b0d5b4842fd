//! Values near a reference.

use super::{MeasuredSeries, Point, Verdict};
use crate::page::number;

/// What a point is held against: the values given, else those of validation.csv.
pub fn limits(point: &Point, (reference, tolerance): (Option<f64>, Option<f64>)) -> Option<(f64, f64)> {
    Some((reference.or(point.reference)?, tolerance.or(point.tolerance)?))
}

/// A line for each point at one of the `at`, or for all points if there are none.
pub fn judge(series: &MeasuredSeries, given: (Option<f64>, Option<f64>), at: &[f64]) -> Vec<Verdict> {
    let judged = series
        .points
        .iter()
        .filter(|point| at.is_empty() || at.contains(&point.x));
    judged.map(|point| judge_point(&series.name(), point, given)).collect()
}

fn judge_point(label: &str, point: &Point, given: (Option<f64>, Option<f64>)) -> Verdict {
    let limits = limits(point, given);
    Verdict {
        of: format!("{label}, x = {}", point.x),
        asked: match limits {
            Some((0.0, tolerance)) => format!("at most {}", number(tolerance)),
            Some((reference, tolerance)) => format!("{} ± {}", number(reference), number(tolerance)),
            None if given.0.or(point.reference).is_none() => "a reference, which is missing".to_owned(),
            None => "a tolerance, which is missing".to_owned(),
        },
        reached: number(point.value),
        pass: limits.is_some_and(|(reference, tolerance)| (point.value - reference).abs() <= tolerance),
    }
}

#[cfg(test)]
mod tests {
    use super::super::through;
    use super::*;

    #[test]
    fn values_are_held_against_what_is_given_or_measured() {
        let mut series = through(&[(1.0, 0.93), (2.0, 0.95)]);
        let verdicts = judge(&series, (Some(0.92), Some(0.02)), &[]);
        assert_eq!(
            verdicts.iter().map(|verdict| verdict.pass).collect::<Vec<_>>(),
            [true, false]
        );
        assert_eq!(verdicts[0].asked, "0.920 ± 0.0200");
        assert_eq!(judge(&series, (Some(0.92), Some(0.02)), &[2.0]).len(), 1);
        assert!(!judge(&series, (None, None), &[])[0].pass);
        assert_eq!(
            judge(&series, (Some(1.0), None), &[])[0].asked,
            "a tolerance, which is missing"
        );
        (series.points[0].reference, series.points[0].tolerance) = (Some(0.0), Some(1.0));
        let verdict = &judge(&series, (None, None), &[1.0])[0];
        assert!(verdict.pass && verdict.asked == "at most 1.00", "{verdict:?}");
    }
}
