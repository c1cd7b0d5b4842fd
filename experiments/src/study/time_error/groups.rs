//! The rows of one target and method, by number of steps.

use super::Row;
use crate::statistics::summarize;
use crate::study::attempt::Status;

/// The runs of one method on one target with one number of steps, one per seed.
pub struct Setting<'a> {
    /// Steps; `None`: the method's own, or draws.
    pub steps: Option<usize>,
    /// The runs.
    pub runs: Vec<&'a Row>,
}

impl Setting<'_> {
    /// The runs with finite particles.
    pub fn finished(&self) -> usize {
        self.runs.iter().filter(|row| row.status == Status::Finished).count()
    }

    /// The median of a quantity over the runs that have it.
    pub fn median(&self, quantity: impl Fn(&Row) -> Option<f64>) -> Option<f64> {
        let values: Vec<f64> = self.runs.iter().filter_map(|row| quantity(row)).collect();
        summarize(&values).ok().map(|summary| summary.median)
    }
}

/// The settings of a method on a target, from few steps to many.
pub fn settings<'a>(rows: &'a [Row], target: &str, method: &str) -> Vec<Setting<'a>> {
    let mut settings: Vec<Setting<'a>> = Vec::new();
    for row in rows.iter().filter(|row| row.target == target && row.method == method) {
        // Diverged runs keep the steps they were asked for, as finished ones do.
        match settings.iter_mut().find(|setting| setting.steps == row.steps) {
            Some(setting) => setting.runs.push(row),
            None => settings.push(Setting {
                steps: row.steps,
                runs: vec![row],
            }),
        }
    }
    settings.sort_by_key(|setting| setting.steps);
    settings
}

/// The expected squared energy distance of M independent draws from a target.
pub fn energy_level(rows: &[Row], target: &str) -> Option<f64> {
    rows.iter().find(|row| row.target == target).map(|row| row.energy_level)
}

/// The median of a quantity over the independent draws from a target.
pub fn independent_level(rows: &[Row], target: &str, quantity: impl Fn(&Row) -> Option<f64>) -> Option<f64> {
    settings(rows, target, "iid").first()?.median(quantity)
}
