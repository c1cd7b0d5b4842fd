//! `[output]`, `[[probes]]` and `[validation]`.

use serde::Deserialize;

use super::ShapeTable;

/// `[output]`: times between what is written. The run hits these times exactly.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutputTable {
    /// Time between frames (.vtu).
    pub interval: f64,
    /// Time between rows of the series. Default: `interval`.
    pub series_interval: Option<f64>,
    /// Time between checkpoints. Default: `interval`.
    pub checkpoint_interval: Option<f64>,
    /// Whether the series says where energy has gone; with transfers that are not FLIP it costs a pass to the nodes in every step. Default: no.
    #[serde(default)]
    pub energy_budget: bool,
}

/// `[[probes]]`: the mean displacement, velocity and stress of some particles as columns of the series, and how far their mass reaches.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeTable {
    /// What its columns begin with.
    pub name: String,
    /// The particle that is nearest to this point at t = 0.
    pub at: Option<Vec<f64>>,
    /// Instead of `at`: all particles in this region at t = 0, weighted by mass.
    pub region: Option<ShapeTable>,
    /// The body whose particles it looks at. Default: all.
    pub body: Option<String>,
    /// A share in (0, 1] of their mass: for each axis the least coordinate that so much of it is not beyond. Default: no such columns.
    pub share: Option<f64>,
}

/// `[validation]`: the reference solution that the run is compared with.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValidationTable {
    /// Its name.
    pub reference: String,
}
