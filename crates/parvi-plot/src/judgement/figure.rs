//! What is asked, as it stands in a figure of the numbers.

use super::bound::limits;
use super::power_law::{fit, within};
use super::{Judgement, MeasuredSeries};
use crate::page::number;
use crate::{GuideCurve, ReferenceLevel, exponent_text};

/// The slopes asked for below the points, and the fitted power laws through them.
pub(super) fn guides(judgements: &[Judgement], judged: &[&MeasuredSeries]) -> Vec<GuideCurve> {
    let mut guides = Vec::new();
    for judgement in judgements {
        match *judgement {
            Judgement::Order { at_least } => guides.extend(slope(judged, at_least, (None, None))),
            Judgement::PowerLaw { exponent, from, to, .. } => {
                for law in judged.iter().filter_map(|series| fit(series, (from, to))) {
                    let label = format!("fit, slope {}", exponent_text(&law, 0));
                    let ends = ends(judged, (from, to));
                    guides.extend(ends.map(|ends| GuideCurve::through(label, ends, true, |x| law.value(&[x]))));
                }
                guides.extend(slope(judged, exponent, (from, to)));
            }
            Judgement::Spread { .. } | Judgement::Bound { .. } => {}
        }
    }
    guides
}

/// A line of this slope at 0.6 of the lowest point of the left end.
fn slope(judged: &[&MeasuredSeries], slope: f64, range: (Option<f64>, Option<f64>)) -> Option<GuideCurve> {
    let (low, high) = ends(judged, range)?;
    let points = judged.iter().flat_map(|series| series.pairs());
    let at_low = points.filter(|&(x, y)| x == low && y > 0.0);
    let start = 0.6 * at_low.map(|(_, y)| y).reduce(f64::min)?;
    let label = format!("slope {}, asked", number(slope));
    let value = |x: f64| start * (x / low).powf(slope);
    Some(GuideCurve::through(label, (low, high), false, value))
}

/// The least and the largest x of the points within a range.
fn ends(judged: &[&MeasuredSeries], range: (Option<f64>, Option<f64>)) -> Option<(f64, f64)> {
    let points = || judged.iter().flat_map(|series| &series.points);
    let x = || points().map(|point| point.x).filter(|x| within(range, *x));
    Some((x().reduce(f64::min)?, x().reduce(f64::max)?))
}

/// The limits that values are held against, each once.
pub(super) fn levels(judgements: &[Judgement], judged: &[&MeasuredSeries]) -> Vec<ReferenceLevel> {
    let mut values: Vec<f64> = Vec::new();
    for judgement in judgements {
        let Judgement::Bound {
            reference,
            tolerance,
            at,
        } = judgement
        else {
            continue;
        };
        let points = judged.iter().flat_map(|series| &series.points);
        let points = points.filter(|point| at.is_empty() || at.contains(&point.x));
        for (reference, tolerance) in points.filter_map(|point| limits(point, (*reference, *tolerance))) {
            values.push(reference + tolerance);
            values.extend((reference != 0.0).then_some(reference - tolerance));
        }
    }
    values.sort_by(f64::total_cmp);
    values.dedup();
    let level = |value| ReferenceLevel::new(value, "limit, asked");
    values.into_iter().map(level).collect()
}
