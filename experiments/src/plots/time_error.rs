//! Error against cost: what each method reaches for its time, on every target.

use crate::statistics::summarize;

use super::chart::{Chart, ChartPanel, ChartSeries, Connection, Level, arrangement};
use super::data::{PlotError, check_size};
use super::scale::AxisKind;
use super::style::styles;

/// The runs of one method at one setting, one entry per seed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorPoint {
    /// The costs, e.g. wall time or score evaluations.
    pub cost: Vec<f64>,
    /// The errors; one that is not finite counts as a failed run.
    pub error: Vec<f64>,
}

/// A method at growing budgets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorCurve {
    /// The method's name, which decides colour and marker.
    pub method: String,
    /// The settings, in the order in which they are connected.
    pub points: Vec<TimeErrorPoint>,
}

/// One target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorPanel {
    /// The target's name.
    pub target: String,
    /// The methods.
    pub curves: Vec<TimeErrorCurve>,
    /// The error of independent draws of the same number.
    pub iid_level: Option<f64>,
}

/// What the bars around a median show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spread {
    /// From the smallest to the largest value.
    #[default]
    Extremes,
    /// From the lower to the upper quartile.
    Quartiles,
}

/// A figure of errors against costs, one panel per target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorPlot {
    /// The title; empty for none.
    pub title: String,
    /// The label of the cost axis, with its unit.
    pub x_label: String,
    /// The label of the error axis, with its unit.
    pub y_label: String,
    /// The text in the legend for the level of independent draws.
    pub iid_label: String,
    /// What the error bars show.
    pub spread: Spread,
    /// The targets.
    pub panels: Vec<TimeErrorPanel>,
}

/// Draws median errors against median costs on logarithmic axes as an SVG document. Failed runs are left out of the medians
/// and counted in a note below the figure.
///
/// # Errors
/// [`PlotError::Empty`] if no run can be drawn, [`PlotError::Size`] if costs and errors differ in number.
pub fn time_error(plot: &TimeErrorPlot) -> Result<String, PlotError> {
    let mut names: Vec<&str> = Vec::new();
    for curve in plot.panels.iter().flat_map(|panel| &panel.curves) {
        if !names.contains(&curve.method.as_str()) {
            names.push(&curve.method);
        }
    }
    let styles = styles(&names);
    let mut failures = Vec::new();
    let mut panels = Vec::with_capacity(plot.panels.len());
    for panel in &plot.panels {
        let mut series = Vec::with_capacity(panel.curves.len());
        for curve in &panel.curves {
            let index = names.iter().position(|name| *name == curve.method);
            let mut drawn = ChartSeries {
                label: curve.method.clone(),
                style: styles[index.unwrap_or(0)],
                x: Vec::new(),
                y: Vec::new(),
                bars: Vec::new(),
                connection: Connection::Solid,
                markers: true,
            };
            let (mut runs, mut failed) = (0, 0);
            for point in &curve.points {
                let what = || format!("{} on {}", curve.method, panel.target);
                check_size(what, point.cost.len(), point.error.len())?;
                let (costs, errors): (Vec<f64>, Vec<f64>) = point
                    .cost
                    .iter()
                    .zip(&point.error)
                    .filter(|(cost, error)| cost.is_finite() && error.is_finite())
                    .unzip();
                runs += point.error.len();
                failed += point.error.len() - errors.len();
                if errors.is_empty() {
                    continue;
                }
                let error = summarize(&errors)?;
                drawn.x.push(summarize(&costs)?.median);
                drawn.y.push(error.median);
                drawn.bars.push(match plot.spread {
                    Spread::Extremes => (error.minimum, error.maximum),
                    Spread::Quartiles => (error.lower_quartile, error.upper_quartile),
                });
            }
            if failed > 0 {
                failures.push(format!("{} on {} ({failed} of {runs})", curve.method, panel.target));
            }
            series.push(drawn);
        }
        panels.push(ChartPanel {
            title: panel.target.clone(),
            x_label: plot.x_label.clone(),
            y_label: plot.y_label.clone(),
            x_kind: AxisKind::Logarithmic,
            y_kind: AxisKind::Logarithmic,
            series,
            levels: panel
                .iid_level
                .map(|value| Level {
                    value,
                    label: plot.iid_label.clone(),
                })
                .into_iter()
                .collect(),
        });
    }
    let mut notes = vec![match plot.spread {
        Spread::Extremes => "Medians over seeds; bars from the smallest to the largest error.".to_string(),
        Spread::Quartiles => "Medians over seeds; bars from the lower to the upper quartile.".to_string(),
    }];
    if !failures.is_empty() {
        notes.push(format!("Runs without a finite error: {}.", failures.join(", ")));
    }
    let (columns, width) = arrangement(plot.panels.len());
    Chart {
        title: plot.title.clone(),
        panels,
        columns,
        width,
        panel_height: if columns == 1 { 210.0 } else { 130.0 },
        notes,
    }
    .draw()
}
