//! `[barrier]`.

use serde::{Deserialize, Serialize};

use super::ShapeTable;

/// `[barrier]`: contact with rigid shapes by the energy b(g) = −k (g − ĝ)² ln(g / ĝ) per area at distances g < ĝ.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BarrierTable {
    /// The rigid shapes.
    #[serde(default)]
    pub shapes: Vec<ShapeTable>,
    /// What else is rigid.
    pub against: Option<BarrierAgainst>,
    /// k, a stress per length.
    pub stiffness: f64,
    /// ĝ, the distance below which the barrier pushes.
    pub gap: f64,
    /// Coefficient of friction μ. Default 0.
    #[serde(default)]
    pub friction: f64,
    /// Sliding speed from which friction is full. Default 0: sticking, as Coulomb's law has it.
    #[serde(default)]
    pub friction_speed: f64,
    /// How its force is taken in a step. Default: explicitly.
    #[serde(default)]
    pub integration: BarrierIntegration,
}

/// `barrier.integration`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BarrierIntegration {
    /// By the distances at the start of the step, which is a fraction of the time of the contact's spring: bounces keep their energy.
    #[default]
    Explicit,
    /// By the distances at its end ([`mpm_core::ContactPotential`]): the step is as long as without a barrier, and impacts lose energy.
    Implicit,
}

/// `barrier.against`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BarrierAgainst {
    /// All that is outside the mesh: its boundary is a wall.
    Mesh,
}
