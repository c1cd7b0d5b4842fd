//! What a chart draws: series, levels and the panels that hold them.

use super::line_series::{GuideCurve, LineSeries};
use super::scale::Axis;
use super::style::{GUIDE, Marker, SeriesStyle};

/// A horizontal line for comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLevel {
    /// The ordinate.
    pub value: f64,
    /// The text in the legend.
    pub label: String,
}

impl ReferenceLevel {
    /// A level with its text in the legend.
    pub fn new(value: f64, label: impl Into<String>) -> Self {
        let label = label.into();
        Self { value, label }
    }
}

/// The dash patterns of lines.
pub(super) const SOLID: &str = "";
pub(super) const DASHED: &str = "4.5 2.5";
pub(super) const DOTTED: &str = "1.2 2.4";

/// A line with its look. Points are in order; values that cannot be drawn interrupt the line.
#[derive(Debug, Clone)]
pub(super) struct ChartSeries {
    /// Points, error bars, and the legend's text; empty for none.
    pub line: LineSeries,
    pub style: SeriesStyle,
    /// The dash pattern of the line between the points, `None` without one.
    pub dash: Option<&'static str>,
    pub markers: bool,
}

impl ChartSeries {
    /// A curve for comparison, without markers.
    pub fn guide(guide: &GuideCurve) -> Self {
        Self {
            line: guide.line.clone(),
            style: SeriesStyle {
                color: GUIDE,
                marker: Marker::Ring,
            },
            dash: Some(if guide.dotted { DOTTED } else { DASHED }),
            markers: false,
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct ChartPanel {
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<ChartSeries>,
    pub levels: Vec<ReferenceLevel>,
}
