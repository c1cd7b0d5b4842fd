//! Forces at given nodes.

use super::GridMotion;
use crate::{Basis, GridNode};

/// Forces f_i at nodes, by their positions: v_i ← v_i + s Δt' f_i / m_i, where s = min(t / `ramp`, 1) and Δt' is [`GridMotion::force_step`]. Nodes that
/// no particle touches, or without mass, have nothing to move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeForces<const D: usize> {
    /// Position and force of every node.
    pub forces: Vec<([f64; D], [f64; D])>,
    /// Time over which they grow in proportion to t; 0: they are there at once.
    pub ramp: f64,
}

impl<const D: usize> NodeForces<D> {
    pub(super) fn act<B: Basis<D>, N: GridNode<D>>(&self, basis: &B, motion: &GridMotion<D>, nodes: &mut [N]) {
        if motion.force_step == 0.0 {
            return;
        }
        let share = if motion.time < self.ramp {
            motion.time / self.ramp
        } else {
            1.0
        };
        for (position, force) in &self.forces {
            let Some(node) = basis
                .node_number(position)
                .and_then(|number| nodes.get_mut(number as usize))
            else {
                continue;
            };
            let mass = node.mass();
            if mass.is_normal() {
                let scale = share * motion.force_step / mass;
                for (v, f) in node.velocity_mut().iter_mut().zip(force) {
                    *v += scale * f;
                }
            }
        }
    }
}
