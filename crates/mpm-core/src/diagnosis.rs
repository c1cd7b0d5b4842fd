//! What made a nodal velocity something other than a number; looked for only once it has happened.

use crate::{ForceLocation, MpmError, Particles};

/// The first force at a particle, else the first force at a node, else the first nodal velocity that is not finite; `nodes` are the positions of the nodes
/// and the forces at them.
#[cold]
#[inline(never)]
pub(crate) fn what_is_not_finite<const D: usize, S: Copy + Send + Sync>(
    location: ForceLocation,
    particles: &Particles<D, S>,
    accelerations: &[[f64; D]],
    (places, forces): (&[[f64; D]], &[[f64; D]]),
    velocity: &dyn Fn(usize) -> [f64; D],
) -> MpmError {
    let fault = match location {
        ForceLocation::Particles => {
            let fault = fault_of_force(&particles.positions, accelerations);
            fault.map(|fault| particles.name(fault))
        }
        ForceLocation::Nodes => fault_of_force(places, forces),
        ForceLocation::Nowhere => None,
    };
    fault.unwrap_or_else(|| fault_of_velocity(places, velocity))
}

fn fault_of_force<const D: usize>(positions: &[[f64; D]], forces: &[[f64; D]]) -> Option<MpmError> {
    let index = forces.iter().position(|force| !is_finite(force))?;
    Some(MpmError::BodyForceNotFinite {
        index,
        position: positions[index].to_vec(),
        value: forces[index].to_vec(),
    })
}

/// The first nodal velocity that is not finite.
pub(crate) fn fault_of_velocity<const D: usize>(
    positions: &[[f64; D]],
    velocity: &dyn Fn(usize) -> [f64; D],
) -> MpmError {
    let node = (0..positions.len()).find(|&node| !is_finite(&velocity(node)));
    let node = node.unwrap_or(0);
    MpmError::VelocityNotFinite {
        position: positions[node].to_vec(),
        velocity: velocity(node).to_vec(),
    }
}

/// Whether all components are.
pub(crate) fn is_finite<const D: usize>(vector: &[f64; D]) -> bool {
    vector.iter().all(|c| c.is_finite())
}
