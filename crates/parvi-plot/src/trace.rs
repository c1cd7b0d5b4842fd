//! Traces of a run: residual, energy and the like against the step.

use super::chart::{Chart, Legend};
use super::data::PlotError;
use super::scale::AxisKind;
use super::series::{ChartPanel, ChartSeries, ReferenceLevel};
use super::style::FIGURE_WIDTH;

/// One quantity of one run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TraceSeries {
    /// The text in the legend; the same run keeps label and colour across panels.
    pub label: String,
    /// The steps.
    pub step: Vec<f64>,
    /// The values; one that is not finite interrupts the line.
    pub value: Vec<f64>,
}

impl TraceSeries {
    /// A line through points (step, value).
    pub fn through(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (step, value) = points.into_iter().unzip();
        let label = label.into();
        Self { label, step, value }
    }
}

/// One quantity of all runs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TracePanel {
    /// The label of the vertical axis, with its unit.
    pub y_label: String,
    /// The division of the vertical axis: by default logarithmic where all values are positive and their range is wide.
    pub y_axis: AxisKind,
    /// The runs.
    pub series: Vec<TraceSeries>,
    /// Horizontal lines, e.g. the value for independent draws.
    pub levels: Vec<ReferenceLevel>,
}

impl TracePanel {
    /// The runs, over an axis with this label.
    pub fn new(y_label: impl Into<String>, y_axis: AxisKind, series: impl IntoIterator<Item = TraceSeries>) -> Self {
        Self {
            y_label: y_label.into(),
            y_axis,
            series: series.into_iter().collect(),
            levels: Vec::new(),
        }
    }
}

/// A quantity of the records of runs.
pub struct TraceQuantity<T> {
    /// The label of its axis.
    pub label: &'static str,
    /// The division of the axis.
    pub axis: AxisKind,
    /// The quantity, where a record has it.
    pub value: fn(&T) -> Option<f64>,
    /// A horizontal line and what it stands for.
    pub level: Option<(f64, &'static str)>,
    /// Whether only differences mean something, so that it is drawn above its least value.
    pub above_least: bool,
}

impl<T> TraceQuantity<T> {
    /// A quantity that is drawn as it is.
    pub const fn plain(label: &'static str, axis: AxisKind, value: fn(&T) -> Option<f64>) -> Self {
        Self {
            label,
            axis,
            value,
            level: None,
            above_least: false,
        }
    }

    /// Its panel for the records of labelled runs, over their steps; a run without values of it is left out.
    pub fn panel(&self, runs: &[(String, Vec<T>)], step: fn(&T) -> f64) -> TracePanel {
        let line = |(label, records): &(String, Vec<T>)| {
            let points = records
                .iter()
                .filter_map(|record| Some((step(record), (self.value)(record)?)));
            let mut line = TraceSeries::through(label.as_str(), points);
            if self.above_least {
                let least = line.value.iter().copied().fold(f64::INFINITY, f64::min);
                line.value.iter_mut().for_each(|value| *value -= least);
            }
            line
        };
        let lines = runs.iter().map(line).filter(|line| !line.step.is_empty());
        let level = |(value, label): (f64, &str)| ReferenceLevel::new(value, label);
        TracePanel {
            levels: self.level.map(level).into_iter().collect(),
            ..TracePanel::new(self.label, self.axis, lines)
        }
    }
}

/// A figure of traces, one panel per quantity.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TracePlot {
    /// The title; empty for none.
    pub title: String,
    /// The label of the horizontal axis, e.g. "step".
    pub x_label: String,
    /// The panels, two in a row.
    pub panels: Vec<TracePanel>,
}

impl TracePlot {
    /// Panels under a title, over axes with this label.
    pub fn new(title: impl Into<String>, x_label: &str, panels: impl IntoIterator<Item = TracePanel>) -> Self {
        Self {
            title: title.into(),
            x_label: x_label.to_owned(),
            panels: panels.into_iter().collect(),
        }
    }
}

/// Draws traces as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] if no value can be drawn, [`PlotError::Size`] if steps and values differ in number.
pub fn trace(plot: &TracePlot) -> Result<String, PlotError> {
    let all = plot.panels.iter().flat_map(|panel| &panel.series);
    let legend = Legend::of(all.map(|series| &series.label));
    let line = |series: &TraceSeries| {
        let label = if legend.len() < 2 { "" } else { &series.label };
        ChartSeries {
            // A line of one point is invisible.
            markers: series.step.len() == 1,
            ..ChartSeries::line(label, legend.style(&series.label), &series.step, &series.value)
        }
    };
    let panels = plot.panels.iter().map(|panel| ChartPanel {
        title: String::new(),
        x_label: plot.x_label.clone(),
        y_label: panel.y_label.clone(),
        x_kind: AxisKind::Linear,
        y_kind: panel.y_axis,
        series: panel.series.iter().map(line).collect(),
        levels: panel.levels.clone(),
    });
    let columns = plot.panels.len().clamp(1, 2);
    Chart {
        title: plot.title.clone(),
        panels: panels.collect(),
        columns,
        width: if columns == 1 {
            0.76 * FIGURE_WIDTH
        } else {
            FIGURE_WIDTH
        },
        panel_height: 150.0,
        notes: Vec::new(),
    }
    .draw()
}
