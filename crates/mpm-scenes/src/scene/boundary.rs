//! `[[walls]]`, `[[obstacles]]` and `[[held]]`.

use serde::Deserialize;

use super::ShapeTable;

/// `[[walls]]`: a plane that bounds the motion on one side, across an axis (`axis`, `side`, `position`) or anyhow (`point`, `normal`).
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallTable {
    /// The axis that it is across.
    pub axis: Option<AxisName>,
    /// Which end of the axis it closes.
    pub side: Option<Side>,
    /// Where it crosses the axis. Default: the domain's border.
    pub position: Option<f64>,
    /// Instead of `axis`, `side` and `position`: a point of it.
    pub point: Option<Vec<f64>>,
    /// With `point`: the direction into the domain, of any length.
    pub normal: Option<Vec<f64>>,
    /// What it does to a body that touches it.
    pub condition: WallCondition,
    /// Velocity of the wall; with `condition = "prescribed"` only.
    pub velocity: Option<Vec<f64>>,
    /// Coefficient of friction μ; with `condition = "friction"` only.
    pub friction: Option<f64>,
}

/// An axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AxisName {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl AxisName {
    /// Its number, counted from 0.
    pub fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
        }
    }
}

/// An end of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Where coordinates are smallest.
    Lower,
    /// Where they are largest.
    Upper,
}

/// `walls.condition`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WallCondition {
    /// Holds the body: v = 0.
    Fixed,
    /// Lets it slide along (roller): v · n = 0.
    Slip,
    /// Moves it: v = `velocity`.
    Prescribed,
    /// Pushes only, and brakes the sliding by Coulomb's law.
    Friction,
}

/// `[[obstacles]]`: a rigid shape that bodies cannot enter.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleTable {
    /// The shape.
    pub shape: ShapeTable,
    /// What it does to a body that touches it.
    pub contact: Contact,
    /// Coefficient of friction μ; with `contact = "separate"` only. Default 0.
    pub friction: Option<f64>,
    /// Its velocity. Default 0.
    pub velocity: Option<Vec<f64>>,
    /// Whether the shape goes with its velocity; else only its surface moves, like a conveyor belt. Default true.
    #[serde(default = "yes")]
    pub moves: bool,
}

fn yes() -> bool {
    true
}

/// `obstacles.contact`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contact {
    /// Holds whatever touches it.
    Stick,
    /// Lets it slide along, never away.
    Slip,
    /// Lets it slide, braked by friction, and leave.
    Separate,
}

/// `[[held]]`: nodes in a region move with a prescribed velocity.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeldTable {
    /// The region.
    pub shape: ShapeTable,
    /// Its velocity. Default 0.
    pub velocity: Option<Vec<f64>>,
}
