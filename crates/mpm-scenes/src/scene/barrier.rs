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
}

/// `barrier.against`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BarrierAgainst {
    /// All that is outside the mesh: its boundary is a wall.
    Mesh,
}
