//! F̄: volume ratios averaged over the nodes, against volumetric locking.

use crate::transfer::{Moving, NodeSums, Sum, gather};
use crate::{Basis, Medium, Particles};

/// Reference and present volume around a node.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NodeVolume {
    reference: f64,
    present: f64,
}

impl Sum for NodeVolume {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.reference += other.reference;
        self.present += other.present;
    }
}

/// F_p ← (J̄_p / J_p)^{1/D} F_p with J̄_p = Σ_i w_ip (Σ_q w_iq V⁰_q J_q / Σ_q w_iq V⁰_q), then whatever the medium admits of
/// it (Zhao, Jiang & Choo 2023: the F̄ method of de Souza Neto et al. 1996, with averages over the grid).
///
/// J is the law's: for a plastic law in plane strain the elastic part of F alone does not have it.
///
/// A particle without a positive volume ratio is left alone; the next step refuses it.
///
/// Neither transfer nor forces matter to it, so it is not a method of [`Mpm`](crate::Mpm), of which there are more kinds to compile.
pub(crate) fn average_volume_ratios<const D: usize, B: Basis<D>, M: Medium<D>>(
    basis: &B,
    medium: &M,
    moving: &mut Particles<D, M::State>,
    node_volumes: &mut NodeSums<NodeVolume>,
) {
    let particles = &*moving;
    node_volumes.scatter(basis, &particles.positions, move |p, x, stencil| {
        let reference = particles.reference_volumes[p];
        let ratio = medium.volume_ratio(&particles.deformation_gradients[p], &particles.states[p]);
        let present = reference * ratio;
        basis.for_each_node(p, x, |index, entry| {
            let node = stencil.node(index);
            node.reference += entry.weight * reference;
            node.present += entry.weight * present;
        });
    });
    let nodes = node_volumes.as_slice();
    gather(
        basis,
        Moving::of(moving),
        move |data: &mut Moving<D, M::State>, k, p, cell_nodes| {
            let own = medium.volume_ratio(&data.deformation_gradients[k], &data.states[k]);
            let mut average = 0.0;
            basis.for_each_node(p, &data.positions[k], |index, entry| {
                let node = &nodes[cell_nodes[index] as usize];
                // Negative weights may leave a node no volume; then there is nothing to average.
                let ratio = if node.reference > 0.0 {
                    node.present / node.reference
                } else {
                    own
                };
                average += entry.weight * ratio;
            });
            let deformation = &mut data.deformation_gradients[k];
            let ratio = average / own;
            let trial = if ratio > 0.0 && ratio < f64::INFINITY {
                *deformation * ratio.powf(1.0 / D as f64)
            } else {
                *deformation
            };
            *deformation = medium.advance(&trial, &mut data.states[k]);
        },
    );
}
