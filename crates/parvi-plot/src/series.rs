//! What a chart draws: series, levels and the panels that hold them.

use super::data::{Curve, PlotError, check_size};
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

/// How the points of a series are connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Connection {
    /// Not at all.
    None,
    /// By solid lines.
    Solid,
    /// By dashed lines.
    Dashed,
    /// By dotted lines.
    Dotted,
    /// By long dashes.
    LongDashed,
    /// By dashes and dots in turn.
    DashDotted,
    /// By short dashes.
    ShortDashed,
}

impl Connection {
    /// The dash pattern of the line, `None` without one.
    pub fn dash(self) -> Option<&'static str> {
        match self {
            Connection::None => None,
            Connection::Solid => Some(""),
            Connection::Dashed => Some("4.5 2.5"),
            Connection::Dotted => Some("1.2 2.4"),
            Connection::LongDashed => Some("9 3"),
            Connection::DashDotted => Some("6 2 1.2 2"),
            Connection::ShortDashed => Some("2.5 1.5"),
        }
    }
}

/// Points (x, y) in order; values that cannot be drawn interrupt the line.
#[derive(Debug, Clone)]
pub(super) struct ChartSeries {
    /// The legend's text; empty for none.
    pub label: String,
    pub style: SeriesStyle,
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// The ends of vertical error bars, or empty.
    pub bars: Vec<(f64, f64)>,
    pub connection: Connection,
    pub markers: bool,
}

impl ChartSeries {
    /// Points with markers, connected by lines.
    pub fn line(label: &str, style: SeriesStyle, x: &[f64], y: &[f64]) -> Self {
        Self {
            label: label.to_owned(),
            style,
            x: x.to_vec(),
            y: y.to_vec(),
            bars: Vec::new(),
            connection: Connection::Solid,
            markers: true,
        }
    }

    /// A curve for comparison, without markers.
    pub fn guide(label: &str, curve: &Curve, connection: Connection) -> Result<Self, PlotError> {
        check_size(|| label.to_owned(), curve.x.len(), curve.y.len())?;
        let style = SeriesStyle {
            color: GUIDE,
            marker: Marker::Ring,
        };
        Ok(Self {
            connection,
            markers: false,
            ..Self::line(label, style, &curve.x, &curve.y)
        })
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
