//! Lines with markers and error bars over one pair of axes.

use super::chart::{Chart, ChartPanel, ChartSeries, Connection, Level, arrangement};
use super::data::PlotError;
use super::scale::AxisKind;
use super::style::styles;

/// A labelled sequence of points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineSeries {
    /// The text in the legend.
    pub label: String,
    /// The abscissas, in the order in which points are connected.
    pub x: Vec<f64>,
    /// The ordinates; a value that is not finite interrupts the line.
    pub y: Vec<f64>,
    /// The lower and upper ends of error bars, one pair per point, or empty.
    pub bars: Vec<(f64, f64)>,
}

/// A horizontal line for comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLevel {
    /// The ordinate.
    pub value: f64,
    /// The text in the legend.
    pub label: String,
}

/// A figure of lines, e.g. the covariance error against the spacing, one series per dimension.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinePlot {
    /// The title; empty for none.
    pub title: String,
    /// The label of the horizontal axis, with its unit.
    pub x_label: String,
    /// The label of the vertical axis, with its unit.
    pub y_label: String,
    /// The division of the horizontal axis.
    pub x_axis: AxisKind,
    /// The division of the vertical axis.
    pub y_axis: AxisKind,
    /// The lines.
    pub series: Vec<LineSeries>,
    /// Horizontal lines for comparison.
    pub levels: Vec<ReferenceLevel>,
}

/// Draws lines as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] if no point can be drawn, [`PlotError::Size`] if lengths differ.
pub fn line(plot: &LinePlot) -> Result<String, PlotError> {
    let names: Vec<&str> = plot.series.iter().map(|s| s.label.as_str()).collect();
    let series = plot
        .series
        .iter()
        .zip(styles(&names))
        .map(|(series, style)| ChartSeries {
            label: series.label.clone(),
            style,
            x: series.x.clone(),
            y: series.y.clone(),
            bars: series.bars.clone(),
            connection: Connection::Solid,
            markers: true,
        })
        .collect();
    let levels = plot.levels.iter().map(Level::from).collect();
    let (columns, width) = arrangement(1);
    let panel = ChartPanel {
        title: String::new(),
        x_label: plot.x_label.clone(),
        y_label: plot.y_label.clone(),
        x_kind: plot.x_axis,
        y_kind: plot.y_axis,
        series,
        levels,
    };
    Chart {
        title: plot.title.clone(),
        panels: vec![panel],
        columns,
        width,
        panel_height: 210.0,
        notes: Vec::new(),
    }
    .draw()
}
