//! The figure of a family: its numbers against x, with what is asked beside them.

use super::family::Family;
use crate::plots::judgement::{Judgement, MeasuredSeries, guides, levels};
use crate::plots::{Axis, AxisKind};
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
    let scale = |is_logarithmic: bool, otherwise: AxisKind| match is_logarithmic {
        true => AxisKind::Logarithmic,
        false => otherwise,
    };
    MultiplesPlot {
        x: Axis::new(x_label, scale(positive, AxisKind::Linear)),
        y: Axis::new(&family.y_label, scale(power, AxisKind::Automatic)),
        panels: vec![MultiplesPanel {
            series: shown.iter().map(|series| line(family, series)).collect(),
            guides: guides(&family.judgements, &judged),
            levels: levels(&family.judgements, &judged),
            ..MultiplesPanel::default()
        }],
        ..MultiplesPlot::default()
    }
}

/// A line that is named even if it is the only one, with gaps where runs ended before their time.
fn line(family: &Family, series: &MeasuredSeries) -> LineSeries {
    let named = Some(&series.label).filter(|label| !label.is_empty());
    LineSeries::through(named.unwrap_or(&family.title), series.pairs_with_gaps())
}
