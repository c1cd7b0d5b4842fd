//! F̄: volume ratios averaged over the nodes, against volumetric locking.

use mpm_tensor::Matrix;

use crate::transfer::{Moving, NodeSums, Sum, gather_cells};
use crate::{Basis, Medium, Member, NO_NODE, Particles};

/// What of the volumes of the particles is averaged over the nodes, against volumetric locking.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VolumeAveraging {
    /// Nothing.
    #[default]
    Off,
    /// The volume ratios J themselves, in every step (Zhao, Jiang & Choo 2023). What is averaged is kept, so that gradients of J, and of the pressure with them, are smoothed on and on: a body at
    /// rest under its weight loses its pressure.
    Ratios,
    /// Their changes in a step. J keeps the gradients that it has while nothing moves; what the nodes do not see of it is forgotten as the particles are sheared.
    Changes,
}

impl VolumeAveraging {
    /// Whether anything is averaged.
    pub(crate) fn acts(self) -> bool {
        self != Self::Off
    }
}

/// Volume around a node, at the beginning and at the end of what is averaged.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NodeVolume {
    before: f64,
    after: f64,
}

impl Sum for NodeVolume {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.before += other.before;
        self.after += other.after;
    }
}

/// How fast J is drawn to its average by shear: what nodes do not see of it falls as e^{−100 γ}, γ = ∫ ‖dev d‖ dt. With 10 a slope of softening clay throws particles on grids.
const PER_SHEAR: f64 = 100.0;

/// The deformation gradients before the particles deform, where changes are averaged.
pub(crate) fn keep_deformations<const D: usize, S>(
    averaging: VolumeAveraging,
    particles: &Particles<D, S>,
    kept: &mut Vec<Matrix<D>>,
) {
    kept.clear();
    if averaging == VolumeAveraging::Changes {
        kept.extend_from_slice(&particles.deformation_gradients);
    }
}

/// R_p = J'_p^{1 − θ}, J' the volume ratio before, θ = min(1, 100 ‖dev sym(ΔF)‖), ΔF = F F'⁻¹.
fn references<const D: usize, M: Medium<D>>(
    medium: &M,
    particles: &Particles<D, M::State>,
    before: &[Matrix<D>],
) -> Vec<f64> {
    let reference = |p: usize| {
        let ratio = medium.volume_ratio(&before[p], &particles.states[p]);
        let Some(inverse) = before[p].inverse() else {
            return ratio;
        };
        let change = particles.deformation_gradients[p] * inverse;
        let symmetric = (change + change.transpose()) * 0.5;
        let shear = symmetric - Matrix::IDENTITY * (symmetric.trace() / D as f64);
        let relaxed = (PER_SHEAR * shear.frobenius_norm()).min(1.0);
        ratio.powf(1.0 - relaxed)
    };
    mpm_parallel::collect(before.len(), 1024, &reference)
}

/// F_p ← (J̄_p / J_p)^{1/D} F_p with J̄_p = R_p Σ_i w_ip (Σ_q w_iq V⁰_q J_q / Σ_q w_iq V⁰_q R_q), then whatever the medium admits of it. R = 1 where the ratios are averaged (Zhao, Jiang & Choo 2023: the F̄
/// method of de Souza Neto et al. 1996, with averages over the grid); for [`VolumeAveraging::Changes`], R = J'^{1 − θ} with J' from `before`: ln J then is ln J' + A (ln J − ln J') − θ (1 − A) ln J' to first order, A the average.
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
    before: &[Matrix<D>],
    node_volumes: &mut NodeSums<NodeVolume>,
) {
    let particles = &*moving;
    let references = references(medium, particles, before);
    let reference = |p: usize| references.get(p).copied().unwrap_or(1.0);
    node_volumes.scatter_cells(
        basis,
        move |cell, particles_of_cell, stencil, (collected, volumes): &mut (B::Cell, [Vec<f64>; 2])| {
            basis.enter(cell, collected);
            for volumes in volumes.iter_mut() {
                volumes.clear();
                volumes.resize(stencil.len(), 0.0);
            }
            for p in particles_of_cell {
                let volume = particles.reference_volumes[p];
                let ratio = medium.volume_ratio(&particles.deformation_gradients[p], &particles.states[p]);
                let sums = volumes.each_mut().map(Vec::as_mut_slice);
                let member = Member {
                    cell: collected,
                    particle: p,
                    x: &particles.positions[p],
                };
                basis.deposit_scalars(member, [volume * reference(p), volume * ratio], sums);
            }
            let [before, after] = &*volumes;
            stencil.for_each_with(before.iter().zip(after), |node, (before, after)| {
                node.before += before;
                node.after += after;
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
                let change = own / reference(p);
                let average = basis.interpolate_scalar(member, ratios.seen_by(change));
                let ratio = average / change;
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

/// What the volume around the nodes of a cell is over what it was, by place.
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
            if node.before <= 0.0 {
                self.unknown.push(place);
            }
            self.values.push(node.after / node.before);
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
