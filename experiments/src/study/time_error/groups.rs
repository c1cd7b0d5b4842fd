//! The rows of one target and method, by number of steps.

use crate::study::run_row::{self, RunRow};

/// The runs of one method on one target with one number of steps, one per seed.
pub struct Setting<'a> {
    /// Steps; `None`: the method's own, or draws.
    pub steps: Option<usize>,
    /// The runs.
    pub runs: Vec<&'a RunRow>,
}

impl Setting<'_> {
    /// The runs with finite particles.
    pub fn finished(&self) -> usize {
        self.runs.iter().filter(|row| row.finished()).count()
    }

    /// The median of a quantity over the runs that have it.
    pub fn median(&self, quantity: impl Fn(&RunRow) -> Option<f64>) -> Option<f64> {
        run_row::median(&self.runs, quantity)
    }
}

/// The settings of a method on a target, from few steps to many.
pub fn settings<'a>(rows: &'a [RunRow], target: &str, method: &str) -> Vec<Setting<'a>> {
    let mut settings: Vec<Setting<'a>> = Vec::new();
    for row in rows.iter().filter(|row| row.target == target && row.method == method) {
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
pub fn energy_level(rows: &[RunRow], target: &str) -> Option<f64> {
    rows.iter().find(|row| row.target == target)?.energy_level
}

/// The median of a quantity over the independent draws from a target.
pub fn independent_level(rows: &[RunRow], target: &str, quantity: impl Fn(&RunRow) -> Option<f64>) -> Option<f64> {
    settings(rows, target, "iid").first()?.median(quantity)
}
