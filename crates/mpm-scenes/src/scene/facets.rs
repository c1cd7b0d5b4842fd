//! `[[facets]]`.

use serde::{Deserialize, Serialize};

use super::{PressureTable, VectorTable};

/// `[[facets]]`: a condition on facets of the mesh, of any shape: those of a physical group of `mesh.file`, or `boundary`, all of its boundary.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FacetTable {
    /// The name of the group; its number where the file names none.
    pub group: String,
    /// What they do to a body that touches them.
    pub condition: FacetCondition,
    /// The velocity of the body at them, a vector or a field; with `condition = "prescribed"` only.
    pub velocity: Option<VectorTable>,
    /// Coefficient of friction μ; with `condition = "friction"` only.
    pub friction: Option<f64>,
    /// Times and the shares of a traction then, linear between them; instead of `ramp`.
    pub amplitude: Option<Vec<[f64; 2]>>,
    /// t, a force per area of the mesh's facets, a vector or a field; with `condition = "traction"` only.
    ///
    /// Taken at the vertices of the facets, and linear between them, as `pressure` is.
    pub traction: Option<VectorTable>,
    /// Instead of `traction`: p in t = −p n, n being the outward normal of a facet; a number or a field.
    pub pressure: Option<PressureTable>,
    /// Time over which a traction grows. Default 0.
    pub ramp: Option<f64>,
}

/// What the group of a table must be, where there is no mesh.
pub(crate) const ON_MESH: &str = "one of a [mesh]: a [grid] has no facets, leave [[facets]] out";

/// `facets.condition`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FacetCondition {
    /// The body sticks.
    Fixed,
    /// It slides along, never away.
    Slip,
    /// It slides, braked by friction, and may leave.
    Friction,
    /// It has a given velocity.
    Prescribed,
    /// A force per area acts on it, where the facets are: a dead load, for bodies that stay at them.
    Traction,
}
