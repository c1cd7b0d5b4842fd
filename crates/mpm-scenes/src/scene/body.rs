//! `[[bodies]]`.

use serde::Deserialize;

use super::{RotationTable, ShapeTable, VectorTable};

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
    /// A turn of the filled shape; two dimensions only.
    pub rotation: Option<RotationTable>,
    /// Particles per axis in a cell of the grid, or in a mean edge of the mesh; Poisson disks are filled to the same number per
    /// volume. Default 2.
    pub particles_per_axis: Option<u32>,
    /// Instead of `particles_per_axis`: the distance between particles, and with `fill = "vertices"` and `"centroids"` the length of
    /// the edges of the body's mesh.
    pub spacing: Option<f64>,
    /// Number of particles; with `fill = "random"` only.
    pub particles: Option<u32>,
    /// Seed of a random filling; with `fill = "poisson-disk"` and `"random"` only. Default 0.
    pub seed: Option<u64>,
    /// Velocity at t = 0. By default the body is at rest.
    pub velocity: Option<VectorTable>,
    /// λ in F = λ 1 at t = 0: the shape is that of the deformed body. Default 1.
    pub deformation: Option<f64>,
}

/// Particles per axis unless a scene says otherwise.
const PARTICLES_PER_AXIS: u32 = 2;

impl BodyTable {
    /// Particles per axis of a cell.
    pub fn per_axis(&self) -> u32 {
        self.particles_per_axis.unwrap_or(PARTICLES_PER_AXIS)
    }
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
    /// Points that are drawn evenly from the shape.
    Random,
    /// The vertices of a mesh of the body, each with its share of the cells around.
    Vertices,
    /// The centres of the cells of a mesh of the body.
    Centroids,
    /// In every cell of the scene's own mesh with its centre in the shape, 3 points in each of `particles_per_axis`² triangles, 2 in each of as many segments, 4 in a tetrahedron: rules of degree two.
    Cells,
}
