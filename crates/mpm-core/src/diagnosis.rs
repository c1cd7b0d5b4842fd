//! What made a nodal velocity something other than a number; looked for only once it has happened.

use crate::{Basis, BodyForce, Boundary, ForceLocation, GridNode, Medium, Mpm, MpmError, Transfer};

impl<const D: usize, B, T, M, F, C> Mpm<D, B, T, M, F, C>
where
    B: Basis<D>,
    T: Transfer<D>,
    M: Medium<D>,
    F: BodyForce<D>,
    C: Boundary<D>,
{
    /// The first force at a particle, else the first force at a node, else the first nodal velocity that is not finite.
    pub(crate) fn what_is_not_finite(&mut self) -> MpmError {
        if self.body_force.location() == ForceLocation::Particles
            && let Some(index) = first_not_finite(&self.accelerations)
        {
            return self.particles.name(MpmError::BodyForceNotFinite {
                index,
                position: self.particles.positions[index].to_vec(),
                value: self.accelerations[index].to_vec(),
            });
        }
        self.basis.node_positions(&mut self.node_positions);
        if self.body_force.location() == ForceLocation::Nodes
            && let Some(index) = first_not_finite(&self.node_forces)
        {
            return MpmError::BodyForceNotFinite {
                index,
                position: self.node_positions[index].to_vec(),
                value: self.node_forces[index].to_vec(),
            };
        }
        let velocities: Vec<[f64; D]> = self.nodes.as_slice().iter().map(|node| *node.velocity()).collect();
        let node = first_not_finite(&velocities).unwrap_or(0);
        MpmError::VelocityNotFinite {
            position: self.node_positions[node].to_vec(),
            velocity: velocities[node].to_vec(),
        }
    }
}

fn first_not_finite<const D: usize>(vectors: &[[f64; D]]) -> Option<usize> {
    vectors.iter().position(|vector| !vector.iter().all(|c| c.is_finite()))
}
