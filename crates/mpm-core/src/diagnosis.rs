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
        self.basis.node_positions(&mut self.node_positions);
        let nodes = self.nodes.as_slice();
        let velocity = |node: usize| *nodes[node].velocity();
        let (places, forces) = (&self.node_positions, &self.node_forces);
        match self.body_force.location() {
            ForceLocation::Particles => {
                let fault = fault_of_force(&self.particles.positions, &self.accelerations);
                let fault = fault.map(|fault| self.particles.name(fault));
                fault.unwrap_or_else(|| fault_of_velocity(places, &velocity))
            }
            ForceLocation::Nodes => {
                let fault = fault_of_force(places, forces);
                fault.unwrap_or_else(|| fault_of_velocity(places, &velocity))
            }
            ForceLocation::Nowhere => fault_of_velocity(places, &velocity),
        }
    }
}

fn fault_of_force<const D: usize>(positions: &[[f64; D]], forces: &[[f64; D]]) -> Option<MpmError> {
    let index = forces.iter().position(|force| !is_finite(force))?;
    Some(MpmError::BodyForceNotFinite {
        index,
        position: positions[index].to_vec(),
        value: forces[index].to_vec(),
    })
}

fn fault_of_velocity<const D: usize>(positions: &[[f64; D]], velocity: &dyn Fn(usize) -> [f64; D]) -> MpmError {
    let node = (0..positions.len()).find(|&node| !is_finite(&velocity(node)));
    let node = node.unwrap_or(0);
    MpmError::VelocityNotFinite {
        position: positions[node].to_vec(),
        velocity: velocity(node).to_vec(),
    }
}

fn is_finite<const D: usize>(vector: &[f64; D]) -> bool {
    vector.iter().all(|c| c.is_finite())
}
