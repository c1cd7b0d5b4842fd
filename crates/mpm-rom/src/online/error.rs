use mpm_scenes::SceneError;

use crate::full_order::FullOrderError;
use crate::least_squares::LeastSquaresError;
use crate::words::in_number;

/// Why a reduced run cannot begin or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OnlineError {
    /// The scene cannot be read as a body.
    #[error(transparent)]
    Body(#[from] FullOrderError),
    /// The scene cannot be filled or held.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A part of the scene that the reduced dynamics do not have.
    #[error("{file}: {field}: must be {expected} in a reduced run")]
    Unsupported {
        /// The scene's file.
        file: String,
        /// The part.
        field: &'static str,
        /// What it must be.
        expected: &'static str,
    },
    /// An option is out of its range.
    #[error("{field} = {value}: must be {expected}")]
    Option {
        /// Its name.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// Fewer sample points than the coordinates and the kinematic regions need.
    #[error(
        "the number of sample points is {found}, at least {needed} are needed: 5 on each kinematic region, and r / D = {coordinates} / {dimension}"
    )]
    TooFewSamples {
        /// |𝒫|.
        found: usize,
        /// The smallest number.
        needed: usize,
        /// r.
        coordinates: usize,
        /// D.
        dimension: usize,
    },
    /// Sample points that are none, or twice the same.
    #[error(
        "sample point {number} of {}: each must be one of them, and named once, in ascending order",
        in_number(*.points, "material point")
    )]
    Samples {
        /// The first number that is wrong.
        number: u32,
        /// N.
        points: usize,
    },
    /// Given sample points that leave a kinematic region out.
    #[error("kinematic region {region} has {found} of the sample points, at least {needed} are needed")]
    TooFewOnRegion {
        /// Its number in the scene.
        region: usize,
        /// How many are.
        found: usize,
        /// 5, or all points of the region if there are fewer.
        needed: usize,
    },
    /// Sample points cannot be chosen on what there is.
    #[error(
        "no sample points can be chosen: of {} from states of training runs none has velocities at {} and Jacobians that tell all coordinates apart",
        in_number(*.readings, "step"),
        in_number(*.points, "point")
    )]
    Readings {
        /// Steps that were read.
        readings: usize,
        /// Points that they should know.
        points: usize,
    },
    /// More sample points than material points.
    #[error("{} of {}", in_number(*.found, "sample point"), in_number(*.points, "material point"))]
    TooManySamples {
        /// |𝒫|.
        found: usize,
        /// N.
        points: usize,
    },
    /// The map has turned a point inside out or made it NaN.
    #[error("step {step}: the map has volume ratio {volume_ratio} at X = {reference:?} from the centroid at rest")]
    Inverted {
        /// Number of the step, counted from 1.
        step: u64,
        /// X, from the centroid at rest.
        reference: Vec<f64>,
        /// J = det F.
        volume_ratio: f64,
    },
    /// A sample point has left the range of the grid's numbers, or is NaN.
    #[error("step {step}: sample point {sample} is at {position:?} from the centroid at rest")]
    Position {
        /// Number of the step, counted from 1.
        step: u64,
        /// Its number among the sample points.
        sample: usize,
        /// Its position.
        position: Vec<f64>,
    },
    /// The sample points are so far apart that the box of nodes around them is too large to be kept.
    #[error("step {step}: the box around the sample points has {places} nodes, at most {most} can be kept")]
    TooManyNodes {
        /// Number of the step, counted from 1.
        step: u64,
        /// Its number of nodes.
        places: f64,
        /// The largest number.
        most: usize,
    },
    /// No node of a sample point has mass: no quadrature point is near it.
    #[error("step {step}: no quadrature point near sample point {sample}")]
    NoMass {
        /// Number of the step, counted from 1.
        step: u64,
        /// Its number among the sample points.
        sample: usize,
    },
    /// Rates or coordinates cannot be computed.
    #[error("step {step}: {source}")]
    Coordinates {
        /// Number of the step, counted from 1.
        step: u64,
        /// Why.
        source: LeastSquaresError,
    },
}
