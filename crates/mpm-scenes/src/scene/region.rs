//! Shapes as the document says them.

use serde::{Deserialize, Serialize};

/// A shape: `{ kind = "sphere", centre = [0.5, 0.5], radius = 0.2 }`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ShapeTable {
    /// All points between two corners; in one dimension an interval.
    Box {
        /// Lowest corner.
        lower: Vec<f64>,
        /// Highest corner.
        upper: Vec<f64>,
    },
    /// All points within `radius` of `centre`: a disk in two dimensions.
    Sphere {
        /// The centre.
        centre: Vec<f64>,
        /// The radius.
        radius: f64,
    },
    /// All points within `radius` of the segment from `start` to `end`.
    Capsule {
        /// One end of the segment.
        start: Vec<f64>,
        /// The other end.
        end: Vec<f64>,
        /// The radius.
        radius: f64,
    },
    /// The inside of a closed polygon that does not cross itself; two dimensions only.
    Polygon {
        /// The corners in either order.
        corners: Vec<[f64; 2]>,
    },
    /// All points below the plane through `point`, away from its `normal`.
    HalfSpace {
        /// A point of the plane.
        point: Vec<f64>,
        /// The direction out of the half-space, of any length.
        normal: Vec<f64>,
    },
    /// Points in any of the shapes.
    Union {
        /// The shapes.
        shapes: Vec<ShapeTable>,
    },
    /// Points in all of the shapes.
    Intersection {
        /// The shapes.
        shapes: Vec<ShapeTable>,
    },
    /// Points of one shape that are in none of the others.
    Difference {
        /// The shape.
        from: Box<ShapeTable>,
        /// What is cut off it.
        remove: Vec<ShapeTable>,
    },
    /// A shape twisted about the z axis; three dimensions only.
    Twist {
        /// The straight shape, with finite bounds.
        shape: Box<ShapeTable>,
        /// Angle per height, in rad/m: the section at height z is turned by rate z.
        rate: f64,
    },
}
