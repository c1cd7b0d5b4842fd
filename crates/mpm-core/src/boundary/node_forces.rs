//! Forces at given nodes, and those of a virtual stress of the particles.

use mpm_tensor::Matrix;
use mpm_tensor::vector::scale;

use super::{Amplitude, Loading};
use crate::{Basis, GridNode, NO_NODE};

/// A symmetric stress σ̂(x) that stands for a load: the particles carry it beside their own, with the other sign, so that a body whose stress it is feels no
/// force, whatever the sums over particles make of integrals.
pub trait VirtualStress<const D: usize>: Send + Sync {
    /// σ̂ at a point; 0 where there is none.
    fn at(&self, x: &[f64; D]) -> Matrix<D>;

    /// Positions of nodes such that σ̂ is 0 at each particle that touches none of them.
    fn nodes(&self) -> &[[f64; D]];
}

/// Forces at nodes, s(t) (f_i + Σ_p V_p σ̂(x_p) ∇w_ip), where V_p is the present volume. Nodes without mass have nothing to move.
#[derive(Default)]
pub struct NodeForces<const D: usize> {
    /// Position and force f_i of every node.
    pub forces: Vec<([f64; D], [f64; D])>,
    /// σ̂, if there is one.
    pub stress: Option<Box<dyn VirtualStress<D>>>,
    /// s.
    pub amplitude: Amplitude,
}

impl<const D: usize> NodeForces<D> {
    pub(super) fn push<B: Basis<D>, N: GridNode<D>>(&self, basis: &B, loading: &Loading<D>, nodes: &mut [N]) {
        let time_step = self.amplitude.at(loading.time) * loading.time_step;
        for (position, force) in &self.forces {
            let number = basis.node_number(position);
            if let Some(node) = number.and_then(|number| nodes.get_mut(number as usize)) {
                node.add_impulse(&scale(force, time_step));
            }
        }
        if let Some(stress) = &self.stress {
            push_stress(&**stress, basis, loading, time_step, nodes);
        }
    }
}

/// Δt V_p σ̂(x_p) ∇w_ip of all particles, ∇w_ip being what their stresses act by.
fn push_stress<const D: usize, B: Basis<D>, N: GridNode<D>>(
    stress: &dyn VirtualStress<D>,
    basis: &B,
    loading: &Loading<D>,
    time_step: f64,
    nodes: &mut [N],
) {
    let mut near = vec![false; nodes.len()];
    for number in stress.nodes().iter().filter_map(|position| basis.node_number(position)) {
        near[number as usize] = true;
    }
    let (schedule, mut scratch) = (basis.schedule(), Vec::new());
    for cell in 0..schedule.cell_count() {
        let numbers = basis.cell_nodes(cell, &mut scratch);
        if !numbers.iter().any(|&number| number != NO_NODE && near[number as usize]) {
            continue;
        }
        for particle in schedule.cell(cell) {
            let x = &loading.extents.positions[particle];
            let impulse = stress.at(x) * (time_step * (loading.extents.volume)(particle));
            if impulse == Matrix::ZERO {
                continue;
            }
            basis.for_each_node(particle, x, |place, entry| {
                let direction = if loading.least_squares {
                    basis.affine_direction(particle, x, entry)
                } else {
                    entry.gradient
                };
                nodes[numbers[place] as usize].add_impulse(&impulse.apply(&direction));
            });
        }
    }
}
