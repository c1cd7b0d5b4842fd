//! `[[facets]]`.

use serde::Deserialize;

use super::{VelocityTable, WallCondition};

/// `[[facets]]`: a condition on facets of the mesh, of any shape: those of a physical group of `mesh.file`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FacetTable {
    /// The name of the group; its number where the file names none.
    pub group: String,
    /// What they do to a body that touches them.
    pub condition: WallCondition,
    /// The velocity of the body at them, a vector or a field; with `condition = "prescribed"` only.
    pub velocity: Option<VelocityTable>,
    /// Coefficient of friction μ; with `condition = "friction"` only.
    pub friction: Option<f64>,
}
