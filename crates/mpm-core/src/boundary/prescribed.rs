use crate::{GridMotion, GridNode};

/// Nodes whose velocity is given.
pub trait PrescribedVelocity<const D: usize>: Send + Sync {
    /// The velocity of a node at x in the step from `time` to `time + time_step`; `None` where none is given.
    fn velocity(&self, x: &[f64; D], time: f64, time_step: f64) -> Option<[f64; D]>;
}

pub(super) fn prescribe<const D: usize, N: GridNode<D>>(
    field: &dyn PrescribedVelocity<D>,
    motion: &GridMotion<D>,
    nodes: &mut [N],
) {
    for (x, node) in motion.positions.iter().zip(nodes) {
        if let Some(velocity) = field.velocity(x, motion.time, motion.time_step) {
            *node.velocity_mut() = velocity;
        }
    }
}
