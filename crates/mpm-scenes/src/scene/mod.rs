//! The document: what a scene file says, one table per file.

mod amplitude;
mod barrier;
mod body;
mod boundary;
mod caution;
mod check;
mod discretisation;
mod facets;
mod field;
mod load;
mod material;
mod mesh;
mod output;
mod read;
mod region;
mod time;
mod volume_averaging;

use std::collections::BTreeMap;
use std::path::PathBuf;

use mpm_core::VolumeAveraging;
use serde::Deserialize;

pub(crate) use amplitude::amplitude;
pub use barrier::{BarrierAgainst, BarrierIntegration, BarrierTable};
pub use body::{BodyTable, FillKind};
pub use boundary::{
    AxisName, Contact, HeldTable, KinematicTable, ObstacleTable, Side, TurningTable, WallCondition, WallTable,
};
pub(crate) use check::MOST_STEPS;
pub use discretisation::{BasisName, Discretisation, DomainTable, GridTable, MomentsName, TransferKind, TransferTable};
pub(crate) use facets::ON_MESH;
pub use facets::{FacetCondition, FacetTable};
pub use field::{Placed, PressureField, PressureTable, VectorField, VectorTable};
pub use load::LoadTable;
pub use material::{FluidTable, GasTable, MaterialTable, MetalTable, SandTable, SnowTable, SolidTable};
pub use mesh::{
    DelaunayTable, GradientName, KernelName, MeshShapeTable, MeshTable, RefinementTable, RotationTable, WidthName,
};
pub use output::{OutputTable, ProbeTable, ValidationTable};
pub(crate) use read::text_of;
pub use region::ShapeTable;
pub use time::{StressUpdateName, TimeTable};

/// A scene: the bodies, what holds and pulls them, how the motion is computed and what is written of it.
///
/// Lengths, masses and times are in any consistent units. Every list that stands for a vector has `dimension` entries.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// What the scene is called.
    pub title: String,
    /// Number of axes: 1, 2 or 3.
    pub dimension: usize,
    /// Acceleration of gravity; none if empty.
    #[serde(default)]
    pub gravity: Vec<f64>,
    /// Time T over which gravity grows as t / T. Default 0: all of it from the start.
    #[serde(default)]
    pub gravity_ramp: f64,
    /// Averaging of volumes over nodes (F-bar), against locking of nearly incompressible materials: `false`, `"changes"` of volume ratios, or the ratios themselves (`true`, `"ratios"`), which
    /// smooths the pressure on and on.
    #[serde(default, deserialize_with = "volume_averaging::read")]
    pub volume_averaging: VolumeAveraging,
    /// Where particles may be. Default: the box around the mesh.
    pub domain: Option<DomainTable>,
    /// The background grid.
    pub grid: Option<GridTable>,
    /// Instead of the grid: the background mesh.
    pub mesh: Option<MeshTable>,
    /// How velocities travel between particles and grid.
    #[serde(default)]
    pub transfer: TransferTable,
    /// How long the motion lasts, and the time step.
    pub time: TimeTable,
    /// The materials by name.
    pub materials: BTreeMap<String, MaterialTable>,
    /// The bodies.
    pub bodies: Vec<BodyTable>,
    /// Walls on planes across the axes.
    #[serde(default)]
    pub walls: Vec<WallTable>,
    /// Conditions on named facets of the mesh.
    #[serde(default)]
    pub facets: Vec<FacetTable>,
    /// Rigid obstacles of any shape.
    #[serde(default)]
    pub obstacles: Vec<ObstacleTable>,
    /// Regions of the grid with a prescribed velocity.
    #[serde(default)]
    pub held: Vec<HeldTable>,
    /// Particles with a prescribed motion.
    #[serde(default)]
    pub kinematic: Vec<KinematicTable>,
    /// Forces on particles.
    #[serde(default)]
    pub loads: Vec<LoadTable>,
    /// Contact with rigid shapes by a barrier energy.
    pub barrier: Option<BarrierTable>,
    /// What is written, and when.
    pub output: OutputTable,
    /// Places whose motion is a part of the series.
    #[serde(default)]
    pub probes: Vec<ProbeTable>,
    /// What the run is compared with.
    pub validation: Option<ValidationTable>,
    /// The file that the scene was read from.
    #[serde(skip)]
    pub file: PathBuf,
    /// Its text.
    #[serde(skip)]
    pub text: String,
}
