//! How a cost grows: measurements on logarithmic axes with fitted power laws.

use crate::statistics::{PowerLaw, fit_power_law};

use super::chart::Chart;
use super::data::{PlotError, check_size};
use super::line_series::{GuideCurve, LineSeries};
use super::multiples::MultiplesPanel;
use super::scale::Axis;
use super::series::{ChartPanel, ChartSeries, SOLID};
use super::style::styles;
use super::text::decimal;

/// A figure of costs against a size.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScalingPlot {
    /// The label of the horizontal axis, with its unit.
    pub x_label: String,
    /// The label of the vertical axis, with its unit.
    pub y_label: String,
    /// The symbol in the legend of the size whose powers are fitted, e.g. "M".
    pub symbol: String,
    /// Measurements with x at least this large are used, so that a fixed cost at small sizes can be left out; 0 for all.
    pub from: f64,
    /// The settings, to the label of each of which the fitted exponent is added, and theoretical curves.
    pub panel: MultiplesPanel,
}

impl ScalingPlot {
    /// Settings over a size with a label and a symbol; measurements from a size on are fitted.
    pub fn over((x_label, symbol): (&str, &str), y_label: &str, series: Vec<LineSeries>, from: f64) -> Self {
        Self {
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            symbol: symbol.to_owned(),
            from,
            panel: MultiplesPanel::new("", series),
        }
    }

    /// The same with a labelled power of the size through the first point of each setting, as far as it stays within so many times the measurements.
    pub fn beside_powers(mut self, powers: impl IntoIterator<Item = (String, i32)>, within: f64) -> Self {
        let settings = &self.panel.series;
        let most = settings
            .iter()
            .flat_map(|series| &series.y)
            .copied()
            .fold(0.0, f64::max);
        let guides = settings.iter().zip(powers);
        let guides =
            guides.filter_map(|(series, (label, power))| GuideCurve::power(label, series, power, most * within));
        self.panel.guides = guides.collect();
        self
    }
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

/// Its positive, finite points.
fn usable(series: &LineSeries) -> impl Iterator<Item = (f64, f64)> {
    let positive = |value: f64| value.is_finite() && value > 0.0;
    series.points().filter(move |&(x, y)| positive(x) && positive(y))
}

/// Draws measurements and fits on logarithmic axes as an SVG document. Points that are not positive are left out.
///
/// # Errors
/// [`PlotError::Empty`] if no point can be drawn, [`PlotError::Size`] if lengths differ.
pub fn scaling(plot: &ScalingPlot) -> Result<String, PlotError> {
    let names: Vec<&str> = plot.panel.series.iter().map(|s| s.label.as_str()).collect();
    let (mut points, mut lines) = (Vec::new(), Vec::new());
    for (series, style) in plot.panel.series.iter().zip(styles(&names)) {
        check_size(|| series.label.clone(), series.x.len(), series.y.len())?;
        let mut label = series.label.clone();
        // Fewer than two different sizes have no power law.
        let fitted: (Vec<f64>, Vec<f64>) = usable(series).filter(|(x, _)| *x >= plot.from).unzip();
        if let Ok(law) = fit_power_law(&fitted.0, &fitted.1) {
            label = format!("{label}: b = {}", exponent_text(&law, 0));
            let low = fitted.0.iter().copied().fold(f64::INFINITY, f64::min);
            let high = fitted.0.iter().copied().fold(0.0, f64::max);
            lines.push(ChartSeries {
                line: LineSeries::through("", [low, high].map(|x| (x, law.value(&[x])))),
                style,
                dash: Some(SOLID),
                markers: false,
            });
        }
        points.push(ChartSeries {
            line: LineSeries::through(label, usable(series)),
            style,
            dash: None,
            markers: true,
        });
    }
    if points.iter().all(|series| series.line.x.is_empty()) {
        return Err(PlotError::empty("series"));
    }
    let is_fitted = !lines.is_empty();
    points.extend(lines);
    points.extend(plot.panel.guides.iter().map(ChartSeries::guide));
    let mut notes = Vec::new();
    if is_fitted {
        let symbol = &plot.symbol;
        let range = if plot.from > 0.0 {
            format!(", {symbol} ≥ {}", plot.from)
        } else {
            String::new()
        };
        notes.push(format!(
            "Lines: least-squares fits ∝ {symbol}^{{b}}{range}; b with its 95 % confidence interval."
        ));
    }
    let panel = ChartPanel {
        title: String::new(),
        x: Axis::logarithmic(&plot.x_label),
        y: Axis::logarithmic(&plot.y_label),
        series: points,
        levels: Vec::new(),
    };
    Chart {
        title: String::new(),
        panels: vec![panel],
        columns: 1,
        panel_height: 220.0,
        notes,
    }
    .draw()
}
