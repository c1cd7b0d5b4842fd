//! Quantities of a run, residual, energy and the like, as panels over its steps.

use super::line_series::LineSeries;
use super::multiples::MultiplesPanel;
use super::scale::AxisKind;

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
    pub fn panel(&self, runs: &[(String, Vec<T>)], step: fn(&T) -> f64) -> MultiplesPanel {
        let line = |(label, records): &(String, Vec<T>)| {
            let points = records
                .iter()
                .filter_map(|record| Some((step(record), (self.value)(record)?)));
            let mut line = LineSeries::through(label.as_str(), points);
            if self.above_least {
                let least = line.y.iter().copied().fold(f64::INFINITY, f64::min);
                line.y.iter_mut().for_each(|value| *value -= least);
            }
            line
        };
        let lines = runs.iter().map(line).filter(|line| !line.x.is_empty());
        let panel = MultiplesPanel::over(self.label, self.axis, lines);
        self.level
            .into_iter()
            .fold(panel, |panel, (value, label)| panel.with_level(value, label))
    }
}
