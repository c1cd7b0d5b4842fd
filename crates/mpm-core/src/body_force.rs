//! External forces: per unit mass at the particles, or as a force at the nodes.

use crate::{ContactPotential, Friction, MpmError};

/// Where an external force acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceLocation {
    /// There is none.
    Nowhere,
    /// Per unit mass at the particles ([`BodyForce::at_particles`]).
    Particles,
    /// At the nodes ([`BodyForce::at_nodes`]).
    Nodes,
}

/// The particles as a body force sees them, at the start of a step and in the present order.
#[derive(Clone, Copy, Debug)]
pub struct Sites<'a, const D: usize> {
    /// x_p.
    pub positions: &'a [[f64; D]],
    /// v_p.
    pub velocities: &'a [[f64; D]],
    /// Numbers of the particles in the order of creation, by which loads and reference positions are looked up.
    pub identities: &'a [u32],
    /// Time since the body was made.
    pub time: f64,
}

/// An external force. What a force does not use is neither stored nor computed.
///
/// The location is a value and not a type: the step looks at it once per particle, and a force
/// that may act at either place needs one compiled step.
pub trait BodyForce<const D: usize>: Sync {
    /// Where the force acts. The step asks several times and counts on one answer.
    fn location(&self) -> ForceLocation;

    /// Force per unit mass at every particle, in the order of `sites`. Every entry of `accelerations` has to be set: it
    /// holds a value of an earlier step.
    ///
    /// # Errors
    /// [`MpmError::BodyForceNotFinite`] with the index of a point where the force is not finite. An implementation may leave
    /// this to the step, which finds such a force before it moves a particle.
    fn at_particles(&mut self, _sites: &Sites<D>, _accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
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
        _masses: &dyn Fn(usize) -> f64,
        _forces: &mut [[f64; D]],
    ) -> Result<(), MpmError> {
        Ok(())
    }

    /// A contact that the step takes implicitly, once all forces have acted; its force is then no part of [`at_particles`](Self::at_particles). `None` where there is none.
    fn contact(&self) -> Option<&dyn ContactPotential<D>> {
        None
    }

    /// Friction where the [`contact`](Self::contact), or the force of the last [`at_particles`](Self::at_particles), presses particles on something; `None` where there is none. It
    /// acts on the nodes once all forces have.
    fn friction(&self) -> Option<Friction<'_, D>> {
        None
    }
}

/// No external force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoBodyForce;

impl<const D: usize> BodyForce<D> for NoBodyForce {
    fn location(&self) -> ForceLocation {
        ForceLocation::Nowhere
    }
}
