//! A row of the study `time-to-equal-error`.

use serde::{Deserialize, Serialize};

use super::Case;
use super::search::{Ending, Medians};
use crate::CommandError;
use crate::study::{definition, results};

/// What a case gave, medians over the seeds. Columns that begin with `wall` depend on the machine, and so does where a search ran
/// out of time; the others depend only on the seeds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case's name.
    pub case: String,
    /// How the search ended.
    pub ending: Ending,
    /// Why there was none.
    pub reason: String,
    /// The target's label.
    pub target: String,
    /// d.
    pub dim: usize,
    /// M of the method.
    pub particles: usize,
    /// The method's label.
    pub method: String,
    /// E‖Y − Y'‖ of the target: divided by n, the expected squared energy distance of n independent draws.
    pub mean_distance: f64,
    /// The squared energy distance to reach; empty for the method that sets it.
    pub goal: Option<f64>,
    /// Draws or steps of the last runs.
    pub size: Option<usize>,
    /// Their score evaluations.
    pub score_evaluations: Option<f64>,
    /// Their evaluations of the log density.
    pub density_evaluations: Option<f64>,
    /// Their squared energy distance; empty if half of them diverged.
    pub energy_distance_squared: Option<f64>,
    /// Their time.
    pub wall_seconds: Option<f64>,
    /// The least.
    pub wall_seconds_least: Option<f64>,
    /// The largest.
    pub wall_seconds_most: Option<f64>,
    /// The largest size that missed the error before it was reached.
    pub missed_size: Option<usize>,
    /// The time of those runs.
    pub wall_seconds_missed: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    /// A row of a search that has not begun.
    pub fn new(case: &Case, mean_distance: f64) -> Result<Self, CommandError> {
        Ok(Self {
            case: definition::Case::id(case),
            target: case.target.label(),
            dim: case.target.dimension()?,
            particles: case.particles,
            method: case.method.label().to_owned(),
            mean_distance,
            ..Self::default()
        })
    }

    /// Notes the last runs.
    pub fn take(&mut self, last: &Medians) {
        self.size = Some(last.size).filter(|size| *size > 0);
        self.score_evaluations = last.score_evaluations;
        self.density_evaluations = last.density_evaluations;
        self.energy_distance_squared = Some(last.energy_distance_squared).filter(|energy| energy.is_finite());
        let [least, median, most] = last.wall_seconds.map(Some);
        (self.wall_seconds_least, self.wall_seconds, self.wall_seconds_most) = (least, median, most);
    }

    /// Notes the runs before the last ones.
    pub fn missed(&mut self, before: &Medians) {
        self.missed_size = Some(before.size);
        self.wall_seconds_missed = Some(before.seconds());
    }

    /// Evaluations of all kinds.
    pub fn evaluations(&self) -> Option<f64> {
        Some(self.score_evaluations? + self.density_evaluations?)
    }

    /// ED² relative to as many independent draws as there are particles.
    pub fn levels(&self) -> Option<f64> {
        Some(self.energy_distance_squared? * self.particles as f64 / self.mean_distance)
    }
}
