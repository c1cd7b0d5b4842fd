//! How a cost grows: measurements on logarithmic axes with fitted power laws.

use crate::statistics::{PowerLaw, fit_power_law};

use super::chart::{Chart, ChartPanel, ChartSeries, Connection, arrangement};
use super::data::{Curve, PlotError, check_size};
use super::scale::AxisKind;
use super::style::{GUIDE, Marker, SeriesStyle, styles};
use super::text::decimal;

/// The measurements of one setting, e.g. one dimension.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScalingSeries {
    /// The text in the legend, to which the fitted exponent is added.
    pub label: String,
    /// The sizes, e.g. numbers of particles.
    pub x: Vec<f64>,
    /// The costs.
    pub y: Vec<f64>,
}

/// A theoretical curve for comparison, drawn dashed.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalingGuide {
    /// The text in the legend.
    pub label: String,
    /// The curve.
    pub curve: Curve,
}

/// A figure of costs against a size.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScalingPlot {
    /// The title; empty for none.
    pub title: String,
    /// The label of the horizontal axis, with its unit.
    pub x_label: String,
    /// The label of the vertical axis, with its unit.
    pub y_label: String,
    /// The symbol of the size in the legend, e.g. "M".
    pub x_symbol: String,
    /// Fits use measurements with x at least this large, so that a fixed cost at small sizes can be left out; 0 for all.
    pub fit_from: f64,
    /// The settings.
    pub series: Vec<ScalingSeries>,
    /// Curves for comparison.
    pub guides: Vec<ScalingGuide>,
}

/// The power law of one series as the figure fits it: over its positive, finite points with x ≥ `fit_from`; `None` where
/// fewer than two different sizes are left.
pub fn scaling_fit(series: &ScalingSeries, fit_from: f64) -> Option<PowerLaw> {
    let (x, y) = usable(series, fit_from);
    fit_power_law(&x, &y).ok()
}

/// An exponent with its 95 % interval for a reader: "0.98 ± 0.02", or "0.98" without an interval.
pub fn exponent_text(law: &PowerLaw, index: usize) -> String {
    let Some(exponent) = law.exponents.get(index) else {
        return String::new();
    };
    match exponent.half_width {
        Some(half_width) => {
            let decimals = if half_width < 0.005 { 3 } else { 2 };
            let value = decimal(exponent.value, decimals);
            format!("{value} ± {}", decimal(half_width, decimals))
        }
        None => decimal(exponent.value, 2),
    }
}

fn usable(series: &ScalingSeries, fit_from: f64) -> (Vec<f64>, Vec<f64>) {
    let positive = |value: f64| value.is_finite() && value > 0.0;
    series
        .x
        .iter()
        .zip(&series.y)
        .filter(|(x, y)| positive(**x) && positive(**y) && **x >= fit_from)
        .map(|(x, y)| (*x, *y))
        .unzip()
}

/// Draws measurements and fits on logarithmic axes as an SVG document. Points that are not positive are left out.
///
/// # Errors
/// [`PlotError::Empty`] if no point can be drawn, [`PlotError::Size`] if lengths differ.
pub fn scaling(plot: &ScalingPlot) -> Result<String, PlotError> {
    let names: Vec<&str> = plot.series.iter().map(|s| s.label.as_str()).collect();
    let mut lines = Vec::new();
    let mut points = Vec::new();
    let mut fits = 0;
    for (series, style) in plot.series.iter().zip(styles(&names)) {
        check_size(|| series.label.clone(), series.x.len(), series.y.len())?;
        let (x, y) = usable(series, 0.0);
        let mut label = series.label.clone();
        if let Some(law) = scaling_fit(series, plot.fit_from) {
            label = format!("{label}: b = {}", exponent_text(&law, 0));
            fits += 1;
            let fitted = x.iter().copied().filter(|x| *x >= plot.fit_from);
            let low = fitted.clone().fold(f64::INFINITY, f64::min);
            let high = fitted.fold(0.0, f64::max);
            lines.push(ChartSeries {
                label: String::new(),
                style,
                x: vec![low, high],
                y: vec![law.value(&[low]), law.value(&[high])],
                bars: Vec::new(),
                connection: Connection::Solid,
                markers: false,
            });
        }
        points.push(ChartSeries {
            label,
            style,
            x,
            y,
            bars: Vec::new(),
            connection: Connection::None,
            markers: true,
        });
    }
    if points.iter().all(|series| series.x.is_empty()) {
        return Err(PlotError::Empty {
            what: "series".to_string(),
        });
    }
    for guide in &plot.guides {
        check_size(|| guide.label.clone(), guide.curve.x.len(), guide.curve.y.len())?;
        lines.push(ChartSeries {
            label: guide.label.clone(),
            style: SeriesStyle {
                color: GUIDE,
                marker: Marker::Ring,
            },
            x: guide.curve.x.clone(),
            y: guide.curve.y.clone(),
            bars: Vec::new(),
            connection: Connection::Dashed,
            markers: false,
        });
    }
    points.extend(lines);
    let mut notes = Vec::new();
    if fits > 0 {
        let symbol = &plot.x_symbol;
        let range = if plot.fit_from > 0.0 {
            format!(", {symbol} ≥ {}", plot.fit_from)
        } else {
            String::new()
        };
        notes.push(format!(
            "Lines: least-squares fits ∝ {symbol}^{{b}}{range}; b with its 95 % confidence interval."
        ));
    }
    let (columns, width) = arrangement(1);
    let panel = ChartPanel {
        title: String::new(),
        x_label: plot.x_label.clone(),
        y_label: plot.y_label.clone(),
        x_kind: AxisKind::Logarithmic,
        y_kind: AxisKind::Logarithmic,
        series: points,
        levels: Vec::new(),
    };
    Chart {
        title: plot.title.clone(),
        panels: vec![panel],
        columns,
        width,
        panel_height: 220.0,
        notes,
    }
    .draw()
}
