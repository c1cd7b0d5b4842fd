use mpm_materials::DeformationError;

/// Why the mechanics refused a state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MpmError {
    /// A position is not a number, or so far out that its grid coordinate leaves the integer range.
    #[error("particle {particle} is at {position:?}, outside the grid's range (spacing {spacing:e})")]
    PositionOutOfRange {
        /// From [`Mpm::step`](crate::Mpm::step): the particle in the order of creation. From
        /// [`Basis::rebuild`](crate::Basis::rebuild): its place in the list of positions.
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// Spacing of the grid.
        spacing: f64,
    },
    /// A particle has left the box it was given.
    #[error("particle {particle} is at {position:?}, outside the domain from {lower:?} to {upper:?}")]
    OutsideDomain {
        /// As in [`PositionOutOfRange`](Self::PositionOutOfRange).
        particle: usize,
        /// Its position.
        position: Vec<f64>,
        /// Lower corner of the domain.
        lower: Vec<f64>,
        /// Upper corner of the domain.
        upper: Vec<f64>,
    },
    /// A particle is in no cell of the mesh.
    #[error("particle {particle} is at {position:?}, in no cell of the mesh")]
    OutsideMesh {
        /// As in [`PositionOutOfRange`](Self::PositionOutOfRange).
        particle: usize,
        /// Its position.
        position: Vec<f64>,
    },
    /// A particle is deformed so that the material has no stress, for example turned inside out.
    #[error("particle {particle}: {source}")]
    Deformation {
        /// From [`Mpm::step`](crate::Mpm::step): the particle in the order of creation. From
        /// [`Medium::wave_speed`](crate::Medium::wave_speed): its place among the particles.
        particle: usize,
        /// What the material says.
        source: DeformationError,
    },
    /// A particle has no finite wave speed although its deformation is admissible: mass or reference volume is at fault.
    #[error(
        "particle {particle} has mass {mass} and reference volume {reference_volume}, at which its wave speed is {wave_speed}"
    )]
    WaveSpeed {
        /// As in [`Deformation`](Self::Deformation).
        particle: usize,
        /// The wave speed.
        wave_speed: f64,
        /// m_p.
        mass: f64,
        /// V⁰_p.
        reference_volume: f64,
    },
    /// The body force at a point is not finite.
    #[error("the body force at {position:?} is {value:?}, which is not finite")]
    BodyForceNotFinite {
        /// From [`Mpm::step`](crate::Mpm::step): the particle in the order of creation, or the number of the node. From a
        /// [`BodyForce`](crate::BodyForce): the index of the point in the batch.
        index: usize,
        /// Where it was evaluated.
        position: Vec<f64>,
        /// What came out.
        value: Vec<f64>,
    },
    /// A nodal velocity is not finite although the body force is: a particle's velocity, mass or stress is at fault.
    #[error("the velocity of the node at {position:?} is {velocity:?}, which is not finite")]
    VelocityNotFinite {
        /// Where the node is.
        position: Vec<f64>,
        /// Its velocity.
        velocity: Vec<f64>,
    },
    /// A particle has reached the surface of something rigid that a [`ContactPotential`](crate::ContactPotential) should keep it from.
    #[error("particle {particle} is at distance {distance} from a rigid surface")]
    Penetration {
        /// As in [`PositionOutOfRange`](Self::PositionOutOfRange).
        particle: usize,
        /// Its distance, ≤ 0.
        distance: f64,
    },
    /// The Courant condition leaves no time step.
    #[error("no time step is short enough for wave speed {wave_speed} and particle speed {particle_speed}")]
    NoTimeStep {
        /// Largest wave speed.
        wave_speed: f64,
        /// Largest speed of a particle.
        particle_speed: f64,
    },
    /// A field of the particles has too many or too few entries, or is missing.
    #[error("particle field {field} has length {length}, not {expected}")]
    FieldLength {
        /// Name of the field.
        field: &'static str,
        /// Its length.
        length: usize,
        /// Number of particles.
        expected: usize,
    },
    /// The stencils need more nodes than 32-bit node numbers can count.
    #[error(
        "the particles touch at least {nodes} nodes, more than can be numbered; use a wider spacing or fewer particles"
    )]
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

/// [`MpmError::InvalidParameter`] unless a value is within its range.
pub(crate) fn within(field: &'static str, value: f64, is_within: bool, expected: &'static str) -> Result<(), MpmError> {
    if is_within {
        return Ok(());
    }
    Err(MpmError::InvalidParameter { field, value, expected })
}

/// The same for coordinates, with the first that is not finite.
pub(crate) fn finite(field: &'static str, coordinates: &[f64]) -> Result<(), MpmError> {
    let bad = coordinates.iter().find(|coordinate| !coordinate.is_finite());
    bad.map_or(Ok(()), |&value| within(field, value, false, "finite"))
}

/// The same for 0 ≤ value < ∞.
pub(crate) fn not_negative(field: &'static str, value: f64) -> Result<(), MpmError> {
    within(
        field,
        value,
        (0.0..f64::INFINITY).contains(&value),
        "at least 0 and finite",
    )
}
