/// Why the mechanics refused a state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MpmError {
    /// A position is not a number, or so far out that its grid coordinate leaves the integer range.
    #[error("particle {particle} is at {position:?}, outside the grid's range (spacing {spacing})")]
    PositionOutOfRange {
        /// Particle, in the order in which it was created.
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// Spacing of the grid.
        spacing: f64,
    },
    /// The body force at a point is not finite.
    #[error("the body force at {position:?} is {value:?}, which is not finite")]
    BodyForceNotFinite {
        /// Index of the point in the batch.
        index: usize,
        /// Where it was evaluated.
        position: Vec<f64>,
        /// What came out.
        value: Vec<f64>,
    },
    /// The stencils need more nodes than 32-bit node numbers can count.
    #[error("{nodes} active nodes exceed the range of node numbers; use a wider spacing or fewer particles")]
    TooManyNodes {
        /// Nodes needed, at least.
        nodes: u64,
    },
    /// A parameter is outside its range.
    #[error("{field} = {value}: must be {expected}")]
    InvalidParameter {
        /// Name of the parameter.
        field: &'static str,
        /// Value given.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
}
