//! `[domain]`, `[grid]` and `[transfer]`.

use serde::{Deserialize, Serialize};

use super::MeshTable;
use crate::SceneFault;
use crate::shape::Bounds;
use crate::values::vector;

/// What a scene is computed on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Discretisation<'a> {
    /// A uniform grid.
    Grid(&'a GridTable),
    /// A mesh.
    Mesh(&'a MeshTable),
}

/// `[domain]`: the box that no particle may leave.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DomainTable {
    /// Its lowest corner.
    pub lower: Vec<f64>,
    /// Its highest corner.
    pub upper: Vec<f64>,
}

impl DomainTable {
    /// The box.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for corners without a finite number for each axis.
    pub(crate) fn room<const D: usize>(&self) -> Result<Bounds<D>, SceneFault> {
        Ok(Bounds {
            lower: vector("domain.lower", &self.lower)?,
            upper: vector("domain.upper", &self.upper)?,
        })
    }
}

/// `[grid]`: the background grid, with a node at `domain.lower`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridTable {
    /// Distance h between nodes.
    pub spacing: f64,
    /// The shape functions.
    #[serde(default)]
    pub basis: BasisName,
}

/// `grid.basis`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BasisName {
    /// Hat functions: 2ᴰ nodes per particle.
    Linear,
    /// Quadratic B-splines: 3ᴰ nodes.
    #[default]
    Quadratic,
    /// Cubic B-splines: 4ᴰ nodes.
    Cubic,
    /// Hat functions averaged over the particle's box (generalised interpolation, uGIMP): 3ᴰ nodes. The box is as wide as the
    /// distance between particles; with PIC and FLIP only.
    Gimp,
}

/// `[transfer]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransferTable {
    /// Which one.
    pub kind: TransferKind,
    /// Share of FLIP in [0, 1], the rest is PIC; with `kind = "flip"` and `"affine-flip"` only. Default 0.99, with `pic_rate` 1. What a share below 1
    /// dissipates depends on the number of steps.
    pub flip_share: Option<f64>,
    /// Rate r at which particle velocities turn into those of PIC, in 1/s: with `pic_order` 1 the share of FLIP in a step is `flip_share` e^{−rΔt}. Default 0; with
    /// `kind = "flip"` and `"affine-flip"` only.
    pub pic_rate: Option<f64>,
    /// Order m of the PIC that velocities turn into at the rate `pic_rate`, XPIC(m): with a larger one smooth motion loses less. Default 1.
    pub pic_order: Option<usize>,
    /// How B_p changes; with `kind = "affine-flip"` only. Default `"nodes"`.
    pub moments: Option<MomentsName>,
}

/// `transfer.moments`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MomentsName {
    /// That of the nodal velocities.
    #[default]
    Nodes,
    /// By that of the change of the nodal velocities, as v_p: no kinetic energy is made.
    Increments,
}

/// `transfer.kind`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TransferKind {
    /// Particle in cell.
    Pic,
    /// FLIP blended with PIC.
    Flip,
    /// FLIP, blended alike, with affine particles (AFLIP).
    AffineFlip,
    /// Affine particle in cell.
    #[default]
    Apic,
    /// Moving least squares: affine, with its own stress force.
    Mls,
}
