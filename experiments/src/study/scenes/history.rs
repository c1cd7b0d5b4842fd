//! Figures over time: columns of the series of a family's runs.

use mpm_scenes::Series;
use mpm_scenes::output::read_series;
use mpm_scenes::reading::curve;

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
fn found(family: &Family, series: &Series, panel: &HistoryPanel) -> Result<Vec<(f64, f64)>, CommandError> {
    let known = || series.columns().join("`, `");
    let message = |name: String| format!("the series has no `{name}`, but `{}`", known());
    let curve = curve(series, &panel.column);
    let curve = curve.map_err(|name| family.refuse("history.column", message(name)))?;
    Ok(curve.points().collect())
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
    let x = |row: &Row| row.number("x").unwrap_or(f64::NAN);
    let is_drawn = |row: &Row| family.drawn.is_empty() || family.drawn.contains(&x(row));
    let finished = rows.having(|row| row.number("value").is_some());
    let drawn = finished.with("family", family.name.as_str()).having(is_drawn);
    if family.history.is_empty() || drawn.is_empty() {
        return Ok(None);
    }
    let several = drawn.places("x").len() > 1;
    let mut runs: Vec<(String, &str)> = Vec::new();
    for row in drawn.iter() {
        let label = match (row.text("label"), several) {
            (label, false) if !label.is_empty() => label.to_owned(),
            ("", _) => format!("{}", x(row)),
            (label, _) => format!("{label}, {}", x(row)),
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
            let points = found(family, &series, history)?;
            let every = points.len().div_ceil(MOST_POINTS).max(1);
            let points = points.into_iter().step_by(every);
            panel.series.push(LineSeries::through(label.as_str(), points));
        }
    }
    Ok(Some(MultiplesPlot::traces("", "time (s)", panels)))
}
