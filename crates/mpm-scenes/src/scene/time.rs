//! `[time]`.

use serde::Deserialize;

/// `[time]`: how long the motion lasts, and the time step.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeTable {
    /// When the run ends; it begins at 0.
    pub end: f64,
    /// Longest time step. By default only the Courant condition limits it; a step above it is an error.
    pub step: Option<f64>,
    /// C in Δt ≤ C h / (c + max |v|), with the wave speed c. Default 0.3.
    #[serde(default = "default_courant")]
    pub courant: f64,
    /// When stresses are updated.
    #[serde(default)]
    pub stress_update: StressUpdateName,
    /// Rate γ of damping: v ← e^{−γΔt} (v + Δt f / m) in every step, with all forces f, tractions and contact among them. Default 0.
    #[serde(default)]
    pub damping: f64,
}

fn default_courant() -> f64 {
    0.3
}

/// `time.stress_update`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StressUpdateName {
    /// At the start of a step, by the velocities that the particles bring (USF).
    First,
    /// At its end, by the new nodal velocities (USL).
    #[default]
    Last,
    /// At its end, by nodal velocities mapped again from the particles (MUSL).
    ModifiedLast,
}
