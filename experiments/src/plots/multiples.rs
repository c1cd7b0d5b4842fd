//! Small multiples: lines with markers, error bars and guides, one panel per setting, under one legend.

use super::chart::{Chart, ChartPanel, ChartSeries, Connection, Level, arrangement};
use super::data::{Curve, PlotError, check_size};
use super::line::{LineSeries, ReferenceLevel};
use super::scale::AxisKind;
use super::style::{GUIDE, Marker, SeriesStyle, styles};

/// A theoretical curve for comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideCurve {
    /// The text in the legend; guides with the same text share an entry.
    pub label: String,
    /// The curve.
    pub curve: Curve,
    /// Whether it is dotted; else dashed.
    pub dotted: bool,
}

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

/// Draws small multiples as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] if no point can be drawn, [`PlotError::Size`] if lengths differ.
pub fn multiples(plot: &MultiplesPlot) -> Result<String, PlotError> {
    let mut names: Vec<&str> = Vec::new();
    for series in plot.panels.iter().flat_map(|panel| &panel.series) {
        if !names.contains(&series.label.as_str()) {
            names.push(&series.label);
        }
    }
    let styles = styles(&names);
    let style = |label: &str| styles[names.iter().position(|name| *name == label).unwrap_or(0)];
    let mut panels = Vec::with_capacity(plot.panels.len());
    for panel in &plot.panels {
        let lines = panel.series.iter().map(|series| ChartSeries {
            label: series.label.clone(),
            style: style(&series.label),
            x: series.x.clone(),
            y: series.y.clone(),
            bars: series.bars.clone(),
            connection: Connection::Solid,
            markers: true,
        });
        let mut drawn: Vec<ChartSeries> = lines.collect();
        for guide in &panel.guides {
            check_size(|| guide.label.clone(), guide.curve.x.len(), guide.curve.y.len())?;
            drawn.push(guide_series(guide));
        }
        panels.push(ChartPanel {
            title: panel.title.clone(),
            x_label: plot.x_label.clone(),
            y_label: plot.y_label.clone(),
            x_kind: plot.x_axis,
            y_kind: plot.y_axis,
            series: drawn,
            levels: panel.levels.iter().map(Level::from).collect(),
        });
    }
    let (columns, width) = arrangement(plot.panels.len());
    Chart {
        title: plot.title.clone(),
        panels,
        columns,
        width,
        panel_height: if columns == 1 { 210.0 } else { 140.0 },
        notes: plot.notes.clone(),
    }
    .draw()
}

fn guide_series(guide: &GuideCurve) -> ChartSeries {
    ChartSeries {
        label: guide.label.clone(),
        style: SeriesStyle {
            color: GUIDE,
            marker: Marker::Ring,
        },
        x: guide.curve.x.clone(),
        y: guide.curve.y.clone(),
        bars: Vec::new(),
        connection: if guide.dotted {
            Connection::Dotted
        } else {
            Connection::Dashed
        },
        markers: false,
    }
}
