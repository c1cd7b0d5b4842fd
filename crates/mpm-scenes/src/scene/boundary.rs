//! `[[walls]]`, `[[obstacles]]`, `[[held]]` and `[[kinematic]]`.

use serde::{Deserialize, Serialize};

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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
        self as usize
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

/// `[[held]]`: nodes in a region that moves as a rigid body, x = c + v t + R(t) (X − c), have the region's velocity.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeldTable {
    /// The region at t = 0.
    pub shape: ShapeTable,
    /// v. Default 0.
    pub velocity: Option<Vec<f64>>,
    /// c and the rate of R. By default it does not turn.
    pub rotation: Option<TurningTable>,
    /// When the nodes are let go. Default: never.
    pub until: Option<f64>,
}

/// `[[kinematic]]`: particles that are in a region at t = 0 move as one rigid body: as the first step begins and at the end of every step they take the position and
/// velocity of x = c + v t + R(t) (X − c).
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KinematicTable {
    /// The region.
    pub region: ShapeTable,
    /// The body whose particles it holds. Default: all.
    pub body: Option<String>,
    /// v. Default 0.
    pub velocity: Option<Vec<f64>>,
    /// c and the rate of R. By default it does not turn.
    pub rotation: Option<TurningTable>,
    /// When the particles are let go. Default: never.
    pub until: Option<f64>,
}

/// `kinematic.rotation` and `held.rotation`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TurningTable {
    /// c, the point that turns stay around; it moves with the velocity.
    pub centre: Vec<f64>,
    /// ω in radians per time: one number in two dimensions, three in three.
    pub rate: Vec<f64>,
}
