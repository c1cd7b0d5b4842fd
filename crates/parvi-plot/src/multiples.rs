//! Small multiples: lines with markers, error bars and guides, one panel per setting, under one legend.

use super::chart::{Chart, Legend, arrangement};
use super::data::{Curve, PlotError};
use super::scale::AxisKind;
use super::series::{ChartPanel, ChartSeries, Connection, ReferenceLevel};
use super::statistics::summarize;

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

impl LineSeries {
    /// A line without points yet.
    pub fn named(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            ..Self::default()
        }
    }

    /// The values in order of size against the share of all that are no larger, in percent; `all` may be more than have a value.
    pub fn in_order(label: impl Into<String>, mut values: Vec<f64>, all: usize) -> Self {
        values.sort_by(f64::total_cmp);
        Self {
            x: (0..values.len())
                .map(|k| 100.0 * (k as f64 + 0.5) / all as f64)
                .collect(),
            y: values,
            ..Self::named(label)
        }
    }

    /// The points (x, y).
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.x.iter().copied().zip(self.y.iter().copied())
    }

    /// Adds the median of the values, with a bar from the least to the largest; nothing where there are none.
    pub fn push_median(&mut self, x: f64, values: &[f64]) {
        if let Ok(summary) = summarize(values) {
            self.x.push(x);
            self.y.push(summary.median);
            self.bars.push((summary.minimum, summary.maximum));
        }
    }

    /// Adds the mean of the values, with a bar from the least to the largest; a value that is not finite interrupts the line.
    pub fn push_mean(&mut self, x: f64, values: &[f64]) {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.x.push(x);
        self.y.push(values.iter().sum::<f64>() / values.len() as f64);
        self.bars.push((least, largest));
    }
}

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

impl GuideCurve {
    /// The line between the values at two ends.
    pub fn through(
        label: impl Into<String>,
        (low, high): (f64, f64),
        dotted: bool,
        value: impl Fn(f64) -> f64,
    ) -> Self {
        Self {
            label: label.into(),
            curve: Curve {
                x: vec![low, high],
                y: vec![value(low), value(high)],
            },
            dotted,
        }
    }
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
