//! `[mesh]`.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// `[mesh]`: a mesh of segments, triangles or tetrahedra as the background, in place of `[grid]` (UMLS-MPM).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshTable {
    /// A file of Gmsh (`.msh`), relative to the directory of the scene.
    pub file: Option<PathBuf>,
    /// Instead of `file`: a mesh that is made.
    pub generate: Option<MeshShapeTable>,
    /// A turn of the mesh; two dimensions only.
    pub rotation: Option<RotationTable>,
    /// Whether cells are added around the mesh: mirrored ones at walls, others elsewhere. Default true.
    #[serde(default = "yes")]
    pub outer_layer: bool,
    /// How far from the mesh (with its outer layer) a particle may be. Default 0: a particle outside is an error.
    #[serde(default)]
    pub reach: f64,
}

fn yes() -> bool {
    true
}

/// A turn about a point, in the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotationTable {
    /// The point that stays.
    pub centre: Vec<f64>,
    /// The angle in degrees, against the clock.
    pub degrees: f64,
}

/// `mesh.generate`: `{ kind = "rectangle", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.1 }`. `size` is the length that edges
/// should have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum MeshShapeTable {
    /// An interval, D = 1.
    Segments {
        /// Where it begins.
        start: f64,
        /// Where it ends.
        end: f64,
        /// Mean length of the segments, met as nearly as whole numbers of them allow.
        size: f64,
        /// Relative lengths that the segments take in turn. Default: all equal.
        #[serde(default = "equal")]
        pattern: Vec<f64>,
    },
    /// A rectangle along the axes, D = 2.
    Rectangle {
        /// Lowest corner.
        lower: [f64; 2],
        /// Highest corner.
        upper: [f64; 2],
        /// Length of edges.
        size: f64,
    },
    /// Equal triangles that cover a rectangle, with straight sides across x only, D = 2.
    Lattice {
        /// Lowest corner.
        lower: [f64; 2],
        /// Highest corner.
        upper: [f64; 2],
        /// Length of edges.
        size: f64,
    },
    /// A polygon that does not cross itself, D = 2.
    Polygon {
        /// The corners in either order.
        corners: Vec<[f64; 2]>,
        /// Polygons that are cut out of it.
        #[serde(default)]
        holes: Vec<Vec<[f64; 2]>>,
        /// Length of edges.
        size: f64,
    },
    /// A disk, D = 2.
    Disk {
        /// Its centre.
        centre: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Length of edges.
        size: f64,
    },
    /// The wavy channel of Cao et al. (2024), §3.4, D = 2.
    Channel {
        /// Its height.
        height: f64,
        /// Length of edges.
        size: f64,
    },
    /// A box along the axes, D = 3.
    Box {
        /// Lowest corner.
        lower: [f64; 3],
        /// Highest corner.
        upper: [f64; 3],
        /// Length of edges.
        size: f64,
    },
    /// A slope: 0 ≤ y ≤ height, 0 ≤ z ≤ width, 0 ≤ x ≤ base + (crest − base) y / height, D = 3.
    Slope {
        /// Along y.
        height: f64,
        /// Length of the top.
        crest: f64,
        /// Length of the bottom.
        base: f64,
        /// Along z.
        width: f64,
        /// Length of edges.
        size: f64,
    },
    /// A ball, D = 3.
    Ball {
        /// Its centre.
        centre: [f64; 3],
        /// Its radius.
        radius: f64,
        /// Length of edges.
        size: f64,
    },
}

fn equal() -> Vec<f64> {
    vec![1.0]
}

impl MeshShapeTable {
    /// The length that edges should have.
    pub fn size(&self) -> f64 {
        match self {
            Self::Segments { size, .. }
            | Self::Rectangle { size, .. }
            | Self::Lattice { size, .. }
            | Self::Polygon { size, .. }
            | Self::Disk { size, .. }
            | Self::Channel { size, .. }
            | Self::Box { size, .. }
            | Self::Slope { size, .. }
            | Self::Ball { size, .. } => *size,
        }
    }

    /// Its number of axes.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Segments { .. } => 1,
            Self::Rectangle { .. }
            | Self::Lattice { .. }
            | Self::Polygon { .. }
            | Self::Disk { .. }
            | Self::Channel { .. } => 2,
            Self::Box { .. } | Self::Slope { .. } | Self::Ball { .. } => 3,
        }
    }
}
