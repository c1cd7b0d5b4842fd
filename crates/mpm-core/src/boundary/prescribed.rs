use super::surface::ON_A_SURFACE;
use crate::{Basis, GridMotion, GridNode};

/// Nodes whose velocity is given.
pub trait PrescribedVelocity<const D: usize>: Send + Sync {
    /// The velocity of a node at x, or up to `close` from there, in the step from `time` to `time + time_step`; `None` where none is given.
    fn velocity(&self, x: &[f64; D], close: f64, time: f64, time_step: f64) -> Option<[f64; D]>;
}

pub(super) fn prescribe<const D: usize, B: Basis<D>, N: GridNode<D>>(
    field: &dyn PrescribedVelocity<D>,
    basis: &B,
    motion: &GridMotion<D>,
    nodes: &mut [N],
) {
    let close = ON_A_SURFACE * basis.spacing();
    for (x, node) in motion.positions.iter().zip(nodes) {
        if let Some(velocity) = field.velocity(x, close, motion.time, motion.time_step) {
            *node.velocity_mut() = velocity;
        }
    }
}
