//! Small multiples: lines with markers, error bars and guides, one panel per setting, under one legend.

use super::chart::{Chart, Legend, arrangement};
use super::data::PlotError;
use super::line_series::{GuideCurve, LineSeries};
use super::scale::AxisKind;
use super::series::{ChartPanel, ChartSeries, Connection, ReferenceLevel};

/// One setting, e.g. one dimension.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplesPanel {
    /// The setting.
    pub title: String,
    /// The lines; those with the same label look the same in every panel.
    pub series: Vec<LineSeries>,
    /// Curves for comparison.
    pub guides: Vec<GuideCurve>,
    /// Horizontal lines for comparison.
    pub levels: Vec<ReferenceLevel>,
}

impl MultiplesPanel {
    /// The lines of a setting.
    pub fn new(title: impl Into<String>, series: impl IntoIterator<Item = LineSeries>) -> Self {
        Self {
            title: title.into(),
            series: series.into_iter().collect(),
            ..Self::default()
        }
    }

    /// The same with a horizontal line more.
    pub fn with_level(mut self, value: f64, label: &str) -> Self {
        self.levels.push(ReferenceLevel::new(value, label));
        self
    }
}

/// A figure of panels whose axes have the same meaning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplesPlot {
    /// The title; empty for none.
    pub title: String,
    /// The label of the horizontal axes, with the unit.
    pub x_label: String,
    /// The label of the vertical axes, with the unit.
    pub y_label: String,
    /// The division of the horizontal axes.
    pub x_axis: AxisKind,
    /// The division of the vertical axes.
    pub y_axis: AxisKind,
    /// The panels.
    pub panels: Vec<MultiplesPanel>,
    /// Notes below the figure.
    pub notes: Vec<String>,
}

impl MultiplesPlot {
    /// Axes with these labels, both logarithmic, and no panel yet.
    pub fn logarithmic(x_label: &str, y_label: &str) -> Self {
        Self {
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            x_axis: AxisKind::Logarithmic,
            y_axis: AxisKind::Logarithmic,
            ..Self::default()
        }
    }

    /// The same with linear horizontal axes.
    pub fn over_linear(self) -> Self {
        let x_axis = AxisKind::Linear;
        Self { x_axis, ..self }
    }

    /// The same with these panels.
    pub fn with_panels(self, panels: impl IntoIterator<Item = MultiplesPanel>) -> Self {
        let panels = panels.into_iter().collect();
        Self { panels, ..self }
    }

    /// The same with a note more.
    pub fn with_note(mut self, note: &str) -> Self {
        self.notes.push(note.to_owned());
        self
    }
}

/// Draws small multiples as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] if no point can be drawn, [`PlotError::Size`] if lengths differ.
pub fn multiples(plot: &MultiplesPlot) -> Result<String, PlotError> {
    draw(plot, 140.0)
}

/// The same with panels of this height, where there are several.
pub(super) fn draw(plot: &MultiplesPlot, panel_height: f64) -> Result<String, PlotError> {
    let all = plot.panels.iter().flat_map(|panel| &panel.series);
    let legend = Legend::of(all.map(|series| &series.label));
    let mut panels = Vec::with_capacity(plot.panels.len());
    for panel in &plot.panels {
        let lines = panel.series.iter().map(|series| ChartSeries {
            bars: series.bars.clone(),
            ..ChartSeries::line(&series.label, legend.style(&series.label), &series.x, &series.y)
        });
        let mut drawn: Vec<ChartSeries> = lines.collect();
        for guide in &panel.guides {
            let dashes = if guide.dotted {
                Connection::Dotted
            } else {
                Connection::Dashed
            };
            drawn.push(ChartSeries::guide(&guide.label, &guide.curve, dashes)?);
        }
        panels.push(ChartPanel {
            title: panel.title.clone(),
            x_label: plot.x_label.clone(),
            y_label: plot.y_label.clone(),
            x_kind: plot.x_axis,
            y_kind: plot.y_axis,
            series: drawn,
            levels: panel.levels.clone(),
        });
    }
    let (columns, width) = arrangement(plot.panels.len());
    Chart {
        title: plot.title.clone(),
        panels,
        columns,
        width,
        panel_height: if columns == 1 { 210.0 } else { panel_height },
        notes: plot.notes.clone(),
    }
    .draw()
}
