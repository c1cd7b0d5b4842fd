//! Figures over time: columns of the series of a family's runs.

use mpm_scenes::output::read_series;
use mpm_scenes::reading::curve;

use super::family::Family;
use super::row::Row;
use crate::CommandError;
use crate::plots::{AxisKind, TracePanel, TracePlot, TraceSeries};
use crate::study::directory::StudyDirectory;

/// Points of a line, at most.
const MOST_POINTS: usize = 400;

/// The figure of the runs whose x is among the family's `drawn`, and of the runs that they are compared with; none where nothing is to be drawn.
///
/// # Errors
/// Series that cannot be read, or without the column.
pub fn plot(family: &Family, rows: &[Row], directory: &StudyDirectory) -> Result<Option<TracePlot>, CommandError> {
    let is_drawn = |row: &&Row| {
        let among = family.drawn.is_empty() || family.drawn.contains(&row.x);
        row.family == family.name && row.value.is_some() && among
    };
    let drawn: Vec<&Row> = rows.iter().filter(is_drawn).collect();
    if family.history.is_empty() || drawn.is_empty() {
        return Ok(None);
    }
    let several = drawn.iter().any(|row| row.x != drawn[0].x);
    let mut runs: Vec<(String, &str)> = Vec::new();
    for row in drawn {
        let label = match (row.label.as_str(), several) {
            (label, false) if !label.is_empty() => label.to_owned(),
            ("", _) => format!("{}", row.x),
            (label, _) => format!("{label}, {}", row.x),
        };
        runs.push((label, &row.scene));
        if let Some(other) = &family.read.against
            && runs.iter().all(|(_, scene)| *scene != row.against)
        {
            runs.push((other.label.clone(), &row.against));
        }
    }
    let mut panels: Vec<TracePanel> = family
        .history
        .iter()
        .map(|panel| TracePanel {
            y_label: panel.label.clone(),
            y_axis: AxisKind::Linear,
            ..TracePanel::default()
        })
        .collect();
    for (label, scene) in runs {
        let series = read_series(&directory.raw(scene))?;
        for (panel, history) in panels.iter_mut().zip(&family.history) {
            let curve = curve(&series, &history.column);
            let curve = curve.map_err(|name| family.refuse("history", format!("the series has no column `{name}`")))?;
            let every = curve.times.len().div_ceil(MOST_POINTS).max(1);
            let (step, value) = curve.points().step_by(every).unzip();
            panel.series.push(TraceSeries {
                label: label.clone(),
                step,
                value,
            });
        }
    }
    Ok(Some(TracePlot {
        title: String::new(),
        x_label: "time (s)".to_owned(),
        panels,
    }))
}
