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

/// Volume around a node: of the reference, at the beginning and at the end of what is averaged.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NodeVolume {
    reference: f64,
    before: f64,
    after: f64,
}

impl Sum for NodeVolume {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.reference += other.reference;
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

/// What the average of a particle starts from.
#[derive(Clone, Copy, Debug)]
struct Start {
    /// J', the volume ratio before.
    ratio: f64,
    /// θ = min(1, 100 ‖dev sym(ΔF)‖), ΔF = F F'⁻¹: the share in which J is drawn to its own average.
    drawn: f64,
}

impl Start {
    /// Where the ratios themselves are averaged.
    const REST: Self = Self { ratio: 1.0, drawn: 0.0 };
}

/// One per particle where changes are averaged.
fn starts<const D: usize, M: Medium<D>>(
    medium: &M,
    particles: &Particles<D, M::State>,
    before: &[Matrix<D>],
) -> Vec<Start> {
    let start = |p: usize| {
        let ratio = medium.volume_ratio(&before[p], &particles.states[p]);
        let Some(inverse) = before[p].inverse() else {
            return Start { ratio, drawn: 0.0 };
        };
        let change = particles.deformation_gradients[p] * inverse;
        let symmetric = (change + change.transpose()) * 0.5;
        let shear = symmetric - Matrix::IDENTITY * (symmetric.trace() / D as f64);
        let drawn = (PER_SHEAR * shear.frobenius_norm()).min(1.0);
        Start { ratio, drawn }
    };
    mpm_parallel::collect(before.len(), 1024, &start)
}

/// F_p ← (J̄_p / J_p)^{1/D} F_p, then whatever the medium admits of it. J̄_p = Σ_i w_ip (Σ_q w_iq V⁰_q J_q / Σ_q w_iq V⁰_q) where the ratios are averaged (Zhao, Jiang & Choo 2023: the F̄
/// method of de Souza Neto et al. 1996, with averages over the grid). For [`VolumeAveraging::Changes`] that is Ĵ_p, and J̄_p = (J'_p Σ_i w_ip (Σ_q w_iq V⁰_q J_q / Σ_q w_iq V⁰_q J'_q))^{1 − θ} Ĵ_p^θ with J'
/// from `before`: ln J then is ln J' + A (ln J − ln J') − θ (1 − A) ln J' to first order, A the average. θ is the particle's own and outside of A: were it inside, its differences from particle to particle would make
/// ripples of a uniform J.
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
    let starts = starts(medium, particles, before);
    let start = |p: usize| starts.get(p).copied().unwrap_or(Start::REST);
    let draws = !starts.is_empty();
    node_volumes.scatter_cells(
        basis,
        move |cell, particles_of_cell, stencil, (collected, volumes): &mut (B::Cell, [Vec<f64>; 3])| {
            basis.enter(cell, collected);
            for volumes in volumes.iter_mut() {
                volumes.clear();
                volumes.resize(stencil.len(), 0.0);
            }
            for p in particles_of_cell {
                let volume = particles.reference_volumes[p];
                let ratio = medium.volume_ratio(&particles.deformation_gradients[p], &particles.states[p]);
                let member = Member {
                    cell: collected,
                    particle: p,
                    x: &particles.positions[p],
                };
                let sums = volumes.each_mut().map(Vec::as_mut_slice);
                basis.deposit_scalars(member, [volume, volume * start(p).ratio, volume * ratio], sums);
            }
            let [reference, before, after] = &*volumes;
            let sums = reference.iter().zip(before).zip(after);
            stencil.for_each_with(sums, |node, ((reference, before), after)| {
                node.reference += reference;
                node.before += before;
                node.after += after;
            });
        },
    );
    let nodes = node_volumes.as_slice();
    gather_cells(
        basis,
        Moving::of(moving),
        move |data: &mut Moving<D, M::State>,
              work,
              first,
              (collected, changes, ratios): &mut (B::Cell, Ratios, Ratios)| {
            basis.enter(work.cell, collected);
            changes.collect(work.nodes, nodes, |node| [node.before, node.after]);
            if draws {
                ratios.collect(work.nodes, nodes, |node| [node.reference, node.after]);
            }
            for p in work.particles {
                let k = p - first;
                let (deformation, state) = (&mut data.deformation_gradients[k], &mut data.states[k]);
                let own = medium.volume_ratio(deformation, state);
                let position = data.positions[k];
                let member = || Member {
                    cell: &*collected,
                    particle: p,
                    x: &position,
                };
                let Start { ratio: before, drawn } = start(p);
                let change = own / before;
                let mut ratio = basis.interpolate_scalar(member(), changes.seen_by(change)) / change;
                if drawn > 0.0 {
                    let average = basis.interpolate_scalar(member(), ratios.seen_by(own));
                    ratio = ratio.powf(1.0 - drawn) * (average / own).powf(drawn);
                }
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
    fn collect(&mut self, numbers: &[u32], nodes: &[NodeVolume], of: impl Fn(&NodeVolume) -> [f64; 2]) {
        self.values.clear();
        self.unknown.clear();
        for (place, &number) in numbers.iter().enumerate() {
            let node = if number == NO_NODE {
                NodeVolume::default()
            } else {
                nodes[number as usize]
            };
            let [before, after] = of(&node);
            if before <= 0.0 {
                self.unknown.push(place);
            }
            self.values.push(after / before);
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
