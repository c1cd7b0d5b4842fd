//! `[[bodies]]`.

use serde::Deserialize;

use super::{ShapeTable, VelocityTable};

/// `[[bodies]]`: a shape filled with particles of one material.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyTable {
    /// Its name, for loads, probes and errors.
    pub name: String,
    /// Where it is at t = 0.
    pub shape: ShapeTable,
    /// The name of its material.
    pub material: String,
    /// How it is filled.
    #[serde(default)]
    pub fill: FillKind,
    /// Particles per axis in a cell of the grid; Poisson disks are filled to the same number per volume. Default 2.
    #[serde(default = "default_particles_per_axis")]
    pub particles_per_axis: u32,
    /// Seed of a random filling. Default 0.
    #[serde(default)]
    pub seed: u64,
    /// Velocity at t = 0. By default the body is at rest.
    pub velocity: Option<VelocityTable>,
}

fn default_particles_per_axis() -> u32 {
    2
}

/// `bodies.fill`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FillKind {
    /// A lattice that divides every cell of the grid into equal parts, one particle in the middle of each.
    #[default]
    Regular,
    /// Random points, no two closer than a fixed distance (Bridson 2007).
    PoissonDisk,
    /// Rings around the centre of a disk or an annulus, without stairs at the edges; two dimensions only.
    Rings,
}
