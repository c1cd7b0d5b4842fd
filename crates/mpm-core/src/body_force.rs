//! External forces: per unit mass at the particles, or as a force at the nodes.

use crate::MpmError;

/// An external force. What a force does not use ([`AT_PARTICLES`](Self::AT_PARTICLES),
/// [`AT_NODES`](Self::AT_NODES)) is neither stored nor computed.
pub trait BodyForce<const D: usize>: Sync {
    /// Whether [`at_particles`](Self::at_particles) gives accelerations.
    const AT_PARTICLES: bool;

    /// Whether [`at_nodes`](Self::at_nodes) gives forces.
    const AT_NODES: bool;

    /// Force per unit mass at every particle, in the order of `positions`. Every entry of `accelerations` has to be set: it
    /// holds a value of an earlier step.
    ///
    /// # Errors
    /// [`MpmError::BodyForceNotFinite`] with the index of a point where the force is not finite. An implementation may leave
    /// this to the step, which finds such a force before it moves a particle.
    fn at_particles(&mut self, _positions: &[[f64; D]], _accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        Ok(())
    }

    /// Force at every node, given the nodal positions and masses. Every entry of `forces` has to be set: it holds a value of
    /// an earlier step. A force on a node without mass moves nothing.
    ///
    /// # Errors
    /// [`MpmError::BodyForceNotFinite`] with the index of a point where the force is not finite. An implementation may leave
    /// this to the step, which finds such a force before it moves a particle.
    fn at_nodes(
        &mut self,
        _positions: &[[f64; D]],
        _masses: impl Fn(usize) -> f64,
        _forces: &mut [[f64; D]],
    ) -> Result<(), MpmError> {
        Ok(())
    }
}

/// No external force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoBodyForce;

impl<const D: usize> BodyForce<D> for NoBodyForce {
    const AT_PARTICLES: bool = false;
    const AT_NODES: bool = false;
}
