//! placeholder

/// Errors of the mechanics.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MpmError {
    /// A position is not finite.
    #[error("particle {particle} is at {position:?}, which is not finite")]
    PositionNotFinite {
        /// Particle.
        particle: usize,
        /// Position.
        position: Vec<f64>,
    },
}
