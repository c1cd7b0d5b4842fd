//! F̄: volume ratios averaged over the nodes, against volumetric locking.

use crate::transfer::{Moving, NodeSums, Sum, gather_cells};
use crate::{Basis, Medium, Member, NO_NODE, Particles};

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
    node_volumes.scatter_cells(
        basis,
        move |cell, particles_of_cell, stencil, (collected, volumes): &mut (B::Cell, [Vec<f64>; 2])| {
            basis.enter(cell, collected);
            for volumes in volumes.iter_mut() {
                volumes.clear();
                volumes.resize(stencil.len(), 0.0);
            }
            for p in particles_of_cell {
                let reference = particles.reference_volumes[p];
                let ratio = medium.volume_ratio(&particles.deformation_gradients[p], &particles.states[p]);
                let sums = volumes.each_mut().map(Vec::as_mut_slice);
                let member = Member {
                    cell: collected,
                    particle: p,
                    x: &particles.positions[p],
                };
                basis.deposit_scalars(member, [reference, reference * ratio], sums);
            }
            let [reference, present] = &*volumes;
            stencil.for_each_with(reference.iter().zip(present), |node, (reference, present)| {
                node.reference += reference;
                node.present += present;
            });
        },
    );
    let nodes = node_volumes.as_slice();
    gather_cells(
        basis,
        Moving::of(moving),
        move |data: &mut Moving<D, M::State>, work, first, (collected, ratios): &mut (B::Cell, Ratios)| {
            basis.enter(work.cell, collected);
            ratios.collect(work.nodes, nodes);
            for p in work.particles {
                let k = p - first;
                let (deformation, state) = (&mut data.deformation_gradients[k], &mut data.states[k]);
                let own = medium.volume_ratio(deformation, state);
                let member = Member {
                    cell: collected,
                    particle: p,
                    x: &data.positions[k],
                };
                let average = basis.interpolate_scalar(member, ratios.seen_by(own));
                let ratio = average / own;
                let trial = if ratio > 0.0 && ratio < f64::INFINITY {
                    *deformation * ratio.powf(1.0 / D as f64)
                } else {
                    *deformation
                };
                *deformation = medium.advance(&trial, state);
            }
        },
    );
}

/// Volume ratios at the nodes of a cell, by place.
#[derive(Default)]
struct Ratios {
    values: Vec<f64>,
    /// Places of the nodes that negative weights have left no volume: there is nothing to average.
    unknown: Vec<usize>,
}

impl Ratios {
    #[inline(always)]
    fn collect(&mut self, numbers: &[u32], nodes: &[NodeVolume]) {
        self.values.clear();
        self.unknown.clear();
        for (place, &number) in numbers.iter().enumerate() {
            let node = if number == NO_NODE {
                NodeVolume::default()
            } else {
                nodes[number as usize]
            };
            if node.reference <= 0.0 {
                self.unknown.push(place);
            }
            self.values.push(node.present / node.reference);
        }
    }

    /// With a particle's own ratio where there is no other.
    #[inline(always)]
    fn seen_by(&mut self, own: f64) -> &[f64] {
        for &place in &self.unknown {
            self.values[place] = own;
        }
        &self.values
    }
}
