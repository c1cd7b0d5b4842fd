//! A row of the study `paper`.

use serde::{Deserialize, Serialize};

use super::Case;
use crate::study::attempt::Status;
use crate::study::yardstick::Errors;
use crate::study::{definition, results};

/// What a run gave. `wall_seconds` depends on the machine, everything else only on the seeds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case's name.
    pub case: String,
    /// `algorithm 1`, `algorithm 2` or the rival.
    pub method: String,
    /// Guards and coordinates.
    pub variant: String,
    /// The target.
    pub target: String,
    /// d.
    pub dim: usize,
    /// Ψ with its parameters.
    pub material: String,
    /// α over the steps.
    pub schedule: String,
    /// Where the force acts.
    pub score: String,
    /// V⁰_p.
    pub volumes: String,
    /// γ.
    pub friction: f64,
    /// h asked for.
    pub spacing: Option<f64>,
    /// Δt asked for.
    pub time_step: Option<f64>,
    /// T asked for.
    pub steps: usize,
    /// M.
    pub particles: usize,
    /// Seed of the run.
    pub seed: u64,
    /// How the run ended.
    pub status: Status,
    /// Why it gave nothing, in a word or two.
    pub reason: String,
    /// The step in which that was seen.
    pub failed_step: Option<usize>,
    /// The error in words.
    pub message: String,
    /// Expectation of ED² for M independent draws, E‖Y − Y'‖ / M.
    pub energy_level: f64,
    /// ED² of the start.
    pub start_energy: Option<f64>,
    /// ED² at the end.
    pub final_energy: Option<f64>,
    /// Sliced Wasserstein distance at the end.
    pub final_sliced: Option<f64>,
    /// Largest error of a mean at the end, in standard deviations.
    pub final_mean: Option<f64>,
    /// Largest relative error of a standard deviation at the end.
    pub final_deviation: Option<f64>,
    /// Largest error of a mode's mass at the end.
    pub final_mass: Option<f64>,
    /// The step of the least ED² among those that were looked at after the start, the last one included.
    pub best_step: Option<usize>,
    /// ED² there.
    pub best_energy: Option<f64>,
    /// Sliced Wasserstein distance there.
    pub best_sliced: Option<f64>,
    /// Evaluations of score and log density at one point.
    pub evaluations: Option<u64>,
    /// Nodes with mass in the last step.
    pub active_nodes: Option<usize>,
    /// Bytes that particles and grid hold.
    pub storage_bytes: Option<usize>,
    /// Time of the sampler alone, without what looks at it.
    pub wall_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    /// A row of a run that has not begun.
    pub fn new(case: &Case, dim: usize, energy_level: f64) -> Self {
        let of_body = |text: String| if case.rival.is_some() { String::new() } else { text };
        let [_, variant, material, schedule, score, volumes, ..] = case.body.parts().map(|(_, text)| of_body(text));
        Self {
            case: definition::Case::id(case),
            method: case.method(),
            variant,
            target: case.target.label(),
            dim,
            material,
            schedule,
            score,
            volumes,
            friction: case.body.friction,
            spacing: case.body.spacing,
            time_step: case.body.time_step,
            steps: case.steps,
            particles: case.particles,
            seed: case.seed,
            energy_level,
            ..Self::default()
        }
    }

    /// Notes a run without particles.
    pub fn fail(&mut self, status: Status, reason: &str, step: Option<usize>, message: String) {
        (self.status, self.failed_step, self.message) = (status, step, message);
        reason.clone_into(&mut self.reason);
    }

    /// Notes the errors at the end.
    pub fn end(&mut self, errors: &Errors) {
        self.final_energy = Some(errors.energy_distance_squared);
        self.final_sliced = Some(errors.sliced_wasserstein);
        self.final_mean = Some(errors.mean);
        self.final_deviation = Some(errors.deviation);
        self.final_mass = errors.mass;
    }

    /// ED² at the end, relative to independent draws.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.final_energy? / self.energy_level)
    }

    /// The least ED², relative to independent draws.
    pub fn best_ratio(&self) -> Option<f64> {
        Some(self.best_energy? / self.energy_level)
    }

    /// ED² of the start, relative to independent draws.
    pub fn start_ratio(&self) -> Option<f64> {
        Some(self.start_energy? / self.energy_level)
    }
}
