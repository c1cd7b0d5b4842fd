//! Error against cost: what each method reaches for its time, on every target.

use crate::results::Rows;
use crate::statistics::summarize;

use super::data::{PlotError, check_size};
use super::line_series::LineSeries;
use super::multiples::{MultiplesPanel, MultiplesPlot, draw};
use super::scale::AxisKind;
use super::series::ReferenceLevel;

/// The runs of one method at one setting, one entry per seed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorPoint {
    /// The costs, e.g. wall time or score evaluations.
    pub cost: Vec<f64>,
    /// The errors; one that is not finite counts as a failed run.
    pub error: Vec<f64>,
}

impl TimeErrorPoint {
    /// The runs of these rows; what they do not have is not finite.
    pub fn of(rows: &Rows<'_>, cost: &str, error: &str) -> Self {
        let numbers = |column: &str| rows.iter().map(|row| row.number(column).unwrap_or(f64::NAN)).collect();
        Self {
            cost: numbers(cost),
            error: numbers(error),
        }
    }
}

/// A method at growing budgets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorCurve {
    /// The method's name, which decides colour and marker.
    pub method: String,
    /// The settings, in the order in which they are connected.
    pub points: Vec<TimeErrorPoint>,
}

impl TimeErrorCurve {
    /// Whether a run has a finite error.
    pub fn is_drawable(&self) -> bool {
        let mut errors = self.points.iter().flat_map(|point| &point.error);
        errors.any(|error| error.is_finite())
    }
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
    /// The targets.
    pub panels: Vec<TimeErrorPanel>,
}

impl TimeErrorPlot {
    /// Panels over axes with these labels.
    pub fn new(x_label: &str, y_label: &str, panels: impl IntoIterator<Item = TimeErrorPanel>) -> Self {
        Self {
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            iid_label: "independent draws".to_owned(),
            panels: panels.into_iter().collect(),
            ..Self::default()
        }
    }
}

/// Draws median errors against median costs on logarithmic axes as an SVG document. Failed runs are left out of the medians
/// and counted in a note below the figure.
///
/// # Errors
/// [`PlotError::Empty`] if no run can be drawn, [`PlotError::Size`] if costs and errors differ in number.
pub fn time_error(plot: &TimeErrorPlot) -> Result<String, PlotError> {
    let mut failures = Vec::new();
    let mut panels = Vec::with_capacity(plot.panels.len());
    for panel in &plot.panels {
        let mut series = Vec::with_capacity(panel.curves.len());
        for curve in &panel.curves {
            let mut line = LineSeries {
                label: curve.method.clone(),
                ..LineSeries::default()
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
                line.x.push(summarize(&costs)?.median);
                line.y.push(error.median);
                line.bars.push((error.minimum, error.maximum));
            }
            if failed > 0 {
                failures.push(format!("{} on {} ({failed} of {runs})", curve.method, panel.target));
            }
            series.push(line);
        }
        let level = |value| ReferenceLevel::new(value, plot.iid_label.as_str());
        panels.push(MultiplesPanel {
            title: panel.target.clone(),
            series,
            guides: Vec::new(),
            levels: panel.iid_level.map(level).into_iter().collect(),
        });
    }
    let mut notes = vec!["Medians over seeds; bars from the smallest to the largest error.".to_owned()];
    if !failures.is_empty() {
        notes.push(format!("Runs without a finite error: {}.", failures.join(", ")));
    }
    let lines = MultiplesPlot {
        title: plot.title.clone(),
        x_label: plot.x_label.clone(),
        y_label: plot.y_label.clone(),
        x_axis: AxisKind::Logarithmic,
        y_axis: AxisKind::Logarithmic,
        panels,
        notes,
    };
    draw(&lines, 130.0)
}
