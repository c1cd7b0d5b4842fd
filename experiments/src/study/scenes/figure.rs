//! The figure of a family: its numbers against x, with what is asked beside them.

use super::family::Family;
use super::judgement::{Judgement, fit, limits};
use super::series::MeasuredSeries;
use crate::plots::ReferenceLevel;
use crate::study::prelude::*;

/// The figure.
pub fn plot(family: &Family, series: &[MeasuredSeries]) -> MultiplesPlot {
    let shown: Vec<&MeasuredSeries> = series.iter().filter(|series| !series.points.is_empty()).collect();
    let is_judged = |series: &&MeasuredSeries| series.is_among(&family.judged);
    let judged: Vec<&MeasuredSeries> = shown.iter().copied().filter(is_judged).collect();
    let is_power = |judgement: &Judgement| matches!(judgement, Judgement::Order { .. } | Judgement::PowerLaw { .. });
    let power = family.judgements.iter().any(is_power);
    let mut points = shown.iter().flat_map(|series| &series.points);
    let positive = points.all(|point| point.x > 0.0);
    let x_label = family.x_label.as_deref().unwrap_or_default();
    MultiplesPlot {
        x_axis: if positive {
            AxisKind::Logarithmic
        } else {
            AxisKind::Linear
        },
        y_axis: if power {
            AxisKind::Logarithmic
        } else {
            AxisKind::Automatic
        },
        panels: vec![MultiplesPanel {
            series: shown.iter().map(|series| line(family, series)).collect(),
            guides: guides(family, &judged),
            levels: levels(family, &judged),
            ..MultiplesPanel::default()
        }],
        ..MultiplesPlot::logarithmic(x_label, &family.y_label)
    }
}

/// A line that is named even if it is the only one.
fn line(family: &Family, series: &MeasuredSeries) -> LineSeries {
    let (x, y) = series.pairs().into_iter().unzip();
    let label = if series.label.is_empty() {
        &family.title
    } else {
        &series.label
    };
    LineSeries {
        x,
        y,
        ..LineSeries::named(label)
    }
}

/// The slopes asked for below the points, and the fitted power laws through them.
fn guides(family: &Family, judged: &[&MeasuredSeries]) -> Vec<GuideCurve> {
    let mut guides = Vec::new();
    for judgement in &family.judgements {
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
fn ends(judged: &[&MeasuredSeries], (from, to): (Option<f64>, Option<f64>)) -> Option<(f64, f64)> {
    let within = |x: &f64| from.is_none_or(|from| *x >= from) && to.is_none_or(|to| *x <= to);
    let points = || judged.iter().flat_map(|series| &series.points);
    let x = || points().map(|point| point.x).filter(within);
    Some((x().reduce(f64::min)?, x().reduce(f64::max)?))
}

/// The limits that values are held against, each once.
fn levels(family: &Family, judged: &[&MeasuredSeries]) -> Vec<ReferenceLevel> {
    let mut values: Vec<f64> = Vec::new();
    for judgement in &family.judgements {
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
