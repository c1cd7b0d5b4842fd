//! A row of the study `stability`.

use serde::{Deserialize, Serialize};

use super::draw::Case;
use crate::options::{Basis, Correction, Draws, Material, MethodName, Score, StepCount, Switch, Transfer};
use crate::study::{definition, results};

/// How a configuration ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ending {
    /// With finite particles.
    #[default]
    Finite,
    /// With a typed error.
    Refused,
    /// With a panic, which must never happen.
    Panicked,
    /// With particles that are not finite and no error, which must never happen either.
    NotFinite,
}

/// A configuration and its ending. Columns that begin with `wall` depend on the machine; the others only on the seed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case's name.
    pub case: String,
    /// How it ended.
    pub ending: Ending,
    /// The kind of error, by its name in the code; empty for finite particles.
    pub reason: String,
    /// The error in words.
    pub message: String,
    /// The step in which it happened.
    pub failed_step: Option<usize>,
    /// Whether finite particles have left the region of start and target, which is divergence in the making.
    pub escaped: bool,
    /// Largest distance of a particle from the target's centre, in scales of the target's own frame.
    pub reach: Option<f64>,
    /// Residual relative to i.i.d. draws.
    pub residual: Option<f64>,
    /// The target.
    pub target: String,
    /// d.
    pub dim: usize,
    /// The method.
    pub method: MethodName,
    /// The basis.
    pub basis: Basis,
    /// M.
    pub particles: usize,
    /// Steps asked for.
    pub steps: Option<usize>,
    /// Factor of the target's frame.
    pub scale: f64,
    /// Whether the frame is turned.
    pub turned: bool,
    /// Mean of the start in units of that frame.
    pub start_mean: Option<f64>,
    /// Standard deviation of the start in units of that frame.
    pub start_sd: Option<f64>,
    /// How the start is drawn.
    pub start_draws: Option<Draws>,
    /// Spacing in units of the default.
    pub spacing_factor: f64,
    /// Spacing in units of that frame.
    pub spacing: Option<f64>,
    /// Time step in units of the default for the spacing.
    pub time_step_factor: f64,
    /// Time step.
    pub time_step: Option<f64>,
    /// Where the score is evaluated.
    pub score: Option<Score>,
    /// Transfer (mpm).
    pub transfer: Option<Transfer>,
    /// Share of FLIP in it (mpm).
    pub flip_share: Option<f64>,
    /// Friction (mpm).
    pub friction: Option<f64>,
    /// Whether the basis varies (mpm).
    pub shifts: Option<Switch>,
    /// Whether the lattice turns (mpm).
    pub rotation: Option<Switch>,
    /// Share of settling steps (mpm).
    pub settling: Option<f64>,
    /// Whether the basis varies while settling (mpm).
    pub settling_shifts: Option<Switch>,
    /// The last move (mpm).
    pub moment_correction: Option<Correction>,
    /// Guards (paper-*).
    pub guards: Option<Switch>,
    /// Elastic law (paper-*).
    pub material: Option<Material>,
    /// Seed of the run.
    pub seed: u64,
    /// Time of the sampler alone.
    pub wall_seconds: f64,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    /// A row of a configuration that has not begun.
    pub fn new(case: &Case) -> Self {
        let options = &case.options;
        Self {
            case: definition::Case::id(case),
            target: case.target.name.clone(),
            dim: case.dim,
            method: case.method,
            basis: case.basis,
            particles: case.particles,
            steps: options.steps.map(StepCount::get),
            scale: case.scale,
            turned: case.turn.is_some(),
            start_mean: options.start_mean,
            start_sd: options.start_sd,
            start_draws: options.start_draws,
            spacing_factor: case.spacing_factor,
            time_step_factor: case.time_step_factor,
            score: options.score,
            transfer: options.transfer,
            flip_share: options.flip_share,
            friction: options.friction,
            shifts: options.shifts,
            rotation: options.rotation,
            settling: options.settling,
            settling_shifts: options.settling_shifts,
            moment_correction: options.moment_correction,
            guards: options.guards,
            material: options.material,
            seed: case.seed,
            ..Self::default()
        }
    }

    /// Whether the run gave nothing that could be of use: an error, a panic, numbers that are none, or particles far off.
    pub fn diverged(&self) -> bool {
        self.ending != Ending::Finite || self.escaped
    }

    /// The method, for the paper's algorithms with their guards.
    pub fn group(&self) -> String {
        match self.guards {
            Some(guards) => format!("{}, guards {guards}", self.method),
            None => self.method.to_string(),
        }
    }
}
