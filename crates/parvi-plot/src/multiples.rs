//! Small multiples: lines with markers, error bars and guides, one panel per setting, under one legend.

use super::chart::{Chart, Legend};
use super::data::PlotError;
use super::line_series::{GuideCurve, LineSeries};
use super::scale::{Axis, AxisKind};
use super::series::{ChartPanel, ChartSeries, DASHED, DOTTED, ReferenceLevel, SOLID};

/// One setting, e.g. one dimension.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplesPanel {
    /// The setting.
    pub title: String,
    /// A vertical axis of its own; else that of the figure.
    pub y: Option<Axis>,
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

    /// Lines over a vertical axis of their own.
    pub fn over(y_label: impl Into<String>, y_axis: AxisKind, series: impl IntoIterator<Item = LineSeries>) -> Self {
        Self {
            y: Some(Axis::new(y_label, y_axis)),
            ..Self::new("", series)
        }
    }

    /// The same with a horizontal line more, where there is one.
    pub fn with_level(mut self, value: impl Into<Option<f64>>, label: &str) -> Self {
        let level = value.into().map(|value| ReferenceLevel::new(value, label));
        self.levels.extend(level);
        self
    }
}

/// How lines look and panels stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Look {
    /// Marked points, as many panels in a row as go well together.
    #[default]
    Points,
    /// The same in lower panels.
    LowPoints,
    /// Bare lines, two panels in a row; one that is alone needs no legend.
    Traces,
}

/// A figure of panels whose axes have the same meaning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplesPlot {
    /// The title; empty for none.
    pub title: String,
    /// The horizontal axes.
    pub x: Axis,
    /// The vertical axes.
    pub y: Axis,
    /// Markers and layout.
    pub look: Look,
    /// The panels.
    pub panels: Vec<MultiplesPanel>,
    /// Notes below the figure.
    pub notes: Vec<String>,
}

impl MultiplesPlot {
    /// Axes with these labels, both logarithmic, and no panel yet.
    pub fn logarithmic(x_label: &str, y_label: &str) -> Self {
        Self {
            x: Axis::logarithmic(x_label),
            y: Axis::logarithmic(y_label),
            ..Self::default()
        }
    }

    /// Quantities of runs, each over a vertical axis of its own, against steps or time.
    pub fn traces(title: impl Into<String>, x_label: &str, panels: impl IntoIterator<Item = MultiplesPanel>) -> Self {
        Self {
            title: title.into(),
            look: Look::Traces,
            ..Self::logarithmic(x_label, "").over_linear().with_panels(panels)
        }
    }

    /// The same with linear horizontal axes.
    pub fn over_linear(mut self) -> Self {
        self.x.kind = AxisKind::Linear;
        self
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

/// The dashes of a line that shows none, one or more lines below it.
const SHOWING: [&str; 3] = [SOLID, DASHED, DOTTED];

/// Colours that come again have dashes of their own where there are no markers to tell them apart.
const OF_TURNS: [&str; 3] = ["9 3", "6 2 1.2 2", "2.5 1.5"];

/// Of a panel's range what a line is wide.
const LINE_SHARE: f64 = 0.01;

/// Draws small multiples as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] if no point can be drawn, [`PlotError::Size`] if lengths differ.
pub fn multiples(plot: &MultiplesPlot) -> Result<String, PlotError> {
    let all = plot.panels.iter().flat_map(|panel| &panel.series);
    let legend = Legend::of(all.map(|series| &series.label));
    let bare = plot.look == Look::Traces;
    let mut panels = Vec::with_capacity(plot.panels.len());
    for panel in &plot.panels {
        let line = |(index, line): (usize, &LineSeries)| {
            let label = if bare && legend.len() < 2 { "" } else { &line.label };
            let dash = match legend.turn(&line.label) {
                _ if !bare => SOLID,
                0 => SHOWING[hidden_by(&panel.series, index).min(2)],
                turn => OF_TURNS[turn.min(3) - 1],
            };
            ChartSeries {
                style: legend.style(&line.label),
                dash: Some(dash),
                // A line of one point is invisible.
                markers: !bare || line.x.len() == 1,
                line: LineSeries {
                    label: label.to_owned(),
                    ..line.clone()
                },
            }
        };
        let lines = panel.series.iter().enumerate().map(line);
        let series = lines.chain(panel.guides.iter().map(ChartSeries::guide)).collect();
        panels.push(ChartPanel {
            title: panel.title.clone(),
            x: plot.x.clone(),
            y: panel.y.as_ref().unwrap_or(&plot.y).clone(),
            series,
            levels: panel.levels.clone(),
        });
    }
    let columns = match panels.len() {
        0 | 1 => 1,
        2 | 4 => 2,
        _ if bare => 2,
        _ => 3,
    };
    Chart {
        title: plot.title.clone(),
        panels,
        columns,
        panel_height: match plot.look {
            Look::Traces => 150.0,
            _ if columns == 1 => 210.0,
            Look::Points => 140.0,
            Look::LowPoints => 130.0,
        },
        notes: plot.notes.clone(),
    }
    .draw()
}

/// Lines of a panel that one lies upon, all the way: the first is drawn on top.
fn hidden_by(series: &[LineSeries], index: usize) -> usize {
    let values = series.iter().flat_map(|series| &series.y).filter(|y| y.is_finite());
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| {
        [low.min(*y), high.max(*y)]
    });
    let line = &series[index];
    let is_near = |(a, b): (&f64, &f64)| a.is_nan() && b.is_nan() || (a - b).abs() <= LINE_SHARE * (high - low);
    let is_hidden = |other: &&LineSeries| line.x == other.x && line.y.iter().zip(&other.y).all(is_near);
    series[index + 1..].iter().filter(is_hidden).count()
}
