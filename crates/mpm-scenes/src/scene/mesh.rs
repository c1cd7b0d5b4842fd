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
    /// The points inside are random, instead of those of a relaxed lattice; of `rectangle`, `polygon`, `disk`, `ring` and `channel` only.
    pub delaunay: Option<DelaunayTable>,
    /// Direction in degrees of edges inside, while the boundary stays; of the same kinds only. Default 0.
    #[serde(default)]
    pub angle: f64,
    /// The shape functions.
    #[serde(default)]
    pub kernel: KernelName,
    /// What stands for their gradients; not with `kernel = "hat"`.
    #[serde(default)]
    pub gradient: GradientName,
    /// How far the shape functions reach; not with `kernel = "hat"`.
    #[serde(default)]
    pub width: WidthName,
    /// Whether weights that least squares make small or negative are kept positive; not with `kernel = "hat"`. Default false, as in the paper.
    #[serde(default)]
    pub positive_weights: bool,
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

/// `mesh.kernel`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum KernelName {
    /// UMLS-MPM: least squares over the first ring with the diminishing function η (Cao et al. 2024, Eq. 32).
    #[default]
    Umls,
    /// The same with η² (3 − 2η) in the place of η, which comes and goes with the slope zero; for `gradient = "exact"`.
    Smooth,
    /// The same without η: weights jump at faces. A control.
    WithoutDiminishing,
    /// Piecewise linear functions, whose gradients jump at faces. A control.
    Hat,
}

/// `mesh.gradient`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GradientName {
    /// That of the least squares fit, which is not ∇ of the weight (Cao et al. 2024, Eq. 29).
    #[default]
    Diffuse,
    /// ∇ of the weight: on irregular meshes a constant stress pulls at no node inside of a body.
    Exact,
}

/// `mesh.width`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WidthName {
    /// With the longest edge of the mesh, everywhere (Cao et al. 2024, §4).
    #[default]
    LongestEdge,
    /// With the longest edges around the particle.
    Local,
}

/// `mesh.delaunay`: a Delaunay mesh of random points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DelaunayTable {
    /// Seed of the points. Default 0.
    #[serde(default)]
    pub seed: u64,
    /// Rounds in which points move to the mean of their neighbours and are triangulated anew. Default 2.
    #[serde(default = "two")]
    pub sweeps: usize,
    /// Places with shorter edges. Default: none.
    #[serde(default)]
    pub refine: Vec<RefinementTable>,
}

fn two() -> usize {
    2
}

/// An entry of `mesh.delaunay.refine`: edges of length size + growth · max(0, |x − centre| − radius), where that is less than the size of the mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RefinementTable {
    /// c.
    pub centre: [f64; 2],
    /// Default 0.
    #[serde(default)]
    pub radius: f64,
    /// The length near c.
    pub size: f64,
    /// Default 0.2.
    #[serde(default = "fifth")]
    pub growth: f64,
}

fn fifth() -> f64 {
    0.2
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
    /// A disk with a hole about its centre, D = 2.
    Ring {
        /// Its centre.
        centre: [f64; 2],
        /// Radius of the hole.
        inner: f64,
        /// Radius of the ring.
        outer: f64,
        /// Length of edges.
        size: f64,
    },
    /// The wavy channel of Cao et al. (2024), §3.4, D = 2.
    Channel {
        /// Where it is closed, at most 0. Default 0.
        #[serde(default)]
        floor: f64,
        /// Where it ends.
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
            | Self::Ring { size, .. }
            | Self::Channel { size, .. }
            | Self::Box { size, .. }
            | Self::Slope { size, .. }
            | Self::Ball { size, .. } => *size,
        }
    }

    /// Whether it is a plane domain between polygons, whose points inside may be chosen.
    pub fn is_between_polygons(&self) -> bool {
        matches!(
            self,
            Self::Rectangle { .. }
                | Self::Polygon { .. }
                | Self::Disk { .. }
                | Self::Ring { .. }
                | Self::Channel { .. }
        )
    }

    /// Its number of axes.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Segments { .. } => 1,
            Self::Rectangle { .. }
            | Self::Lattice { .. }
            | Self::Polygon { .. }
            | Self::Disk { .. }
            | Self::Ring { .. }
            | Self::Channel { .. } => 2,
            Self::Box { .. } | Self::Slope { .. } | Self::Ball { .. } => 3,
        }
    }
}
