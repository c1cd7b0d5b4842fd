//! Figures over time: columns of the series of a family's runs.

use mpm_scenes::Series;
use mpm_scenes::output::read_series;
use mpm_scenes::reading::curve;
use mpm_scenes::reference::curve::Curve;

use super::family::{Family, HistoryPanel};
use crate::plots::AxisKind;
use crate::study::prelude::*;

/// Points of a line, at most.
const MOST_POINTS: usize = 400;

/// Refuses columns that a series does not have.
pub fn check(family: &Family, series: &Series) -> Result<(), CommandError> {
    let mut panels = family.history.iter();
    panels.try_for_each(|panel| found(family, series, panel).map(drop))
}

/// What a panel shows of a series.
fn found(family: &Family, series: &Series, panel: &HistoryPanel) -> Result<Curve, CommandError> {
    curve(series, &panel.column).map_err(|message| family.refuse("history.column", message))
}

/// The figure of the runs whose x is among the family's `drawn`, and of the runs that they are compared with; none where nothing is to be drawn.
///
/// # Errors
/// Series that cannot be read, or without the column.
pub fn plot(
    family: &Family,
    rows: &Rows<'_>,
    directory: &StudyDirectory,
) -> Result<Option<MultiplesPlot>, CommandError> {
    let is_drawn = |x: f64| family.drawn.is_empty() || family.drawn.contains(&x);
    let finished = rows.having(|row| row.number("value").is_some() && row.number("x").is_some_and(is_drawn));
    let drawn = finished.with("family", family.name.as_str());
    if family.history.is_empty() || drawn.is_empty() {
        return Ok(None);
    }
    let several = drawn.places("x").len() > 1;
    let mut runs: Vec<(String, &str)> = Vec::new();
    for row in drawn.iter() {
        let x = row.value("x").to_string();
        let label = match row.text("label") {
            "" => x,
            label if several => format!("{label}, {x}"),
            label => label.to_owned(),
        };
        runs.push((label, row.text("scene")));
        let against = row.text("against");
        if let Some(other) = &family.read.against
            && runs.iter().all(|(_, scene)| *scene != against)
        {
            runs.push((other.label.clone(), against));
        }
    }
    let panel = |panel: &HistoryPanel| MultiplesPanel::over(panel.label.as_str(), AxisKind::Linear, []);
    let mut panels: Vec<MultiplesPanel> = family.history.iter().map(panel).collect();
    for (label, scene) in runs {
        let series = read_series(&directory.raw(scene))?;
        for (panel, history) in panels.iter_mut().zip(&family.history) {
            let curve = found(family, &series, history)?;
            let line = LineSeries::through(label.as_str(), curve.thinned(MOST_POINTS));
            panel.series.push(line);
        }
    }
    Ok(Some(MultiplesPlot::traces("", "time (s)", panels)))
}
