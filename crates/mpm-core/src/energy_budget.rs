//! Where kinetic energy goes in a step.

use mpm_tensor::vector::{accumulate, add, dot, scale, subtract};

use crate::transfer::{GridNode, Transfer};
use crate::{Basis, BodyForce, Boundary, Medium, Mpm, StressUpdate, StressWork};

/// What the kinetic energy of the nodes, K = ½ Σ m_i |v_i|², has gained in all steps, by what gave them impulses. Nodes get v_iⁿ from the particles; then forces, contact, friction and
/// boundary give impulses J_i, each in its turn, up to v_iⁿ⁺¹. All of them act over the same step, so that the work of each is Σ J_i · (v_iⁿ + v_iⁿ⁺¹) / 2: together they are what K gains,
/// and what neither moves nor has moved, as a body that sticks, does no work.
///
/// With damping it is v_iⁿ⁺¹ = e^(−γΔt) (v_iⁿ + Σ J_i / m_i), whatever the J_i are of: what changes velocities after they have been damped gives e^(−γΔt) J_i. Works are those of J_i
/// themselves, and the impulse of damping is −(e^(γΔt) − 1) m_i v_iⁿ⁺¹, which is none at rest.
///
/// With it what every other part takes follows. Particles have gained less than the nodes have altogether: the transfer takes the difference, on both its ways. What forces have given is
/// the energy that strain, gravity and other potentials have lost, but for the error of the time integration.
///
/// Where transfers do not keep v_iⁿ at the nodes, it costs a second pass from the particles to the nodes in every step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyBudget {
    /// The work of stresses and body forces, less what the limit of the [`displacement`](crate::StepControl::displacement) takes.
    pub forces: f64,
    /// The work of damping at the rate [`friction`](crate::StepControl::friction), of everything that acts: −Σ (e^(γΔt) − 1) m_i v_iⁿ⁺¹ · (v_iⁿ + v_iⁿ⁺¹) / 2.
    pub damping: f64,
    /// The work of a [`ContactPotential`](crate::ContactPotential).
    pub contact: f64,
    /// The work of Coulomb's [`Friction`](crate::Friction).
    pub friction: f64,
    /// The work of the [`Boundary`](crate::Boundary), that of [`NodeForces`](crate::NodeForces) among it.
    pub boundary: f64,
    /// The part of `boundary` that is the work of [`NodeForces`](crate::NodeForces).
    pub node_forces: f64,
    /// What the viscous part of the stresses takes, their work along the motion less that of the stresses at rest; no part of what the nodes gain, whose `forces` it is in. 0 unless particles
    /// deform last ([`StressUpdate::Last`](crate::StressUpdate::Last)).
    pub viscous: f64,
    /// What the integration in time takes of the energy of the whole body, negative where it gives some; no part of what the nodes gain. Forces are those where a step begins, the
    /// motion is the one with v_iⁿ⁺¹: particles then store V⁰ψ((I + Δt L_p) F_p), which is not what they had and the work of their stresses (of second order in Δt), and forces do
    /// Σ J_i · (v_iⁿ⁺¹ − v_iⁿ) / 2 more along the motion than above. Both are computed for what they are, by particles and by nodes, so that the energy of an elastic body without averaged volumes
    /// is what it began with less all that is said here, up to rounding. Particles that yield in a step are left out: what their stresses have done and they do not store is dissipated. 0 unless particles deform last ([`StressUpdate::Last`](crate::StressUpdate::Last)).
    pub time_integration: f64,
}

impl EnergyBudget {
    /// Σ of all works: what the nodes have gained altogether.
    pub fn sum(&self) -> f64 {
        self.forces + self.damping + self.contact + self.friction + self.boundary
    }

    /// Add the works of a step from the velocities at its stages; called once per step, it is compiled once for all bodies with such nodes.
    #[inline(never)]
    fn add_works<N: GridNode<D>, const D: usize>(
        &mut self,
        nodes: &[N],
        Stages { velocities, pushed }: &Stages<D>,
        damping: f64,
        deforms_last: bool,
    ) {
        let [brought, _, _, _, last] = &velocities[..] else {
            return;
        };
        let sum_of = |impulse: &dyn Fn(usize) -> [f64; D], way: &dyn Fn(usize) -> [f64; D]| -> f64 {
            let each = (0..nodes.len()).map(|i| 0.5 * nodes[i].mass() * dot(&impulse(i), &way(i)));
            each.sum()
        };
        let way = |i: usize| add(&brought[i], &last[i]);
        // What velocities at a stage were before damping, e^(γΔt) v.
        let rise = 1.0 / damping.max(f64::MIN_POSITIVE);
        let undamped = |stage: usize, i: usize| scale(&velocities[stage][i], rise);
        let pushed = |i: usize| match pushed.get(i) {
            Some(impulse) if nodes[i].mass().is_normal() => scale(impulse, 1.0 / nodes[i].mass()),
            _ => [0.0; D],
        };
        let forces = |i: usize| subtract(&subtract(&undamped(1, i), &brought[i]), &pushed(i));
        let after = |stage: usize| sum_of(&|i| subtract(&undamped(stage + 1, i), &undamped(stage, i)), &way);
        self.forces += sum_of(&forces, &way);
        self.contact += after(1);
        self.friction += after(2);
        let node_forces = sum_of(&pushed, &way);
        self.node_forces += node_forces;
        self.boundary += node_forces + after(3);
        self.damping += sum_of(&|i| subtract(&last[i], &undamped(4, i)), &way);
        if deforms_last {
            self.time_integration += sum_of(&forces, &|i| subtract(&last[i], &brought[i]));
        }
    }
}

impl<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>, F: BodyForce<D>, C: Boundary<D>> Mpm<D, B, T, M, F, C> {
    /// The velocities of the nodes so far, v_iⁿ, before any force; none without a budget, or where the nodes keep them.
    pub(crate) fn velocities_brought(&mut self, dt: f64) -> Stages<D> {
        let mut stages = Stages::default();
        if self.energy_budget.is_some() && !T::INCREMENTAL {
            self.momentum_of_particles(dt);
            stages.push(self.nodes.as_slice(), GridNode::velocity);
        }
        stages
    }

    /// Add `sign` times the impulses that the nodes have, before they are velocities: the boundary's forces are what these are more afterwards.
    pub(crate) fn record_impulses(&self, stages: &mut Stages<D>, sign: f64) {
        if self.energy_budget.is_some() {
            stages.pushed.resize(self.nodes.as_slice().len(), [0.0; D]);
            for (sum, node) in stages.pushed.iter_mut().zip(self.nodes.as_slice()) {
                accumulate(sum, sign, node.velocity());
            }
        }
    }

    /// Something has given the nodes impulses.
    pub(crate) fn record(&self, stages: &mut Stages<D>) {
        if self.energy_budget.is_some() {
            if T::INCREMENTAL && stages.velocities.is_empty() {
                stages.push(self.nodes.as_slice(), GridNode::velocity_brought);
            }
            stages.push(self.nodes.as_slice(), GridNode::velocity);
        }
    }

    /// Add the works of a step, now that the velocities are v_iⁿ⁺¹ and forces with damping, contact, friction and boundary have been recorded.
    pub(crate) fn account(&mut self, stages: &Stages<D>, damping: f64) {
        if let Some(budget) = &mut self.energy_budget {
            let deforms_last = M::DEFORMS && self.stress_update == StressUpdate::Last;
            budget.add_works(self.nodes.as_slice(), stages, damping, deforms_last);
            if deforms_last {
                self.stress_works.resize(self.particles.len(), StressWork::default());
            }
        }
    }

    /// Add what has become of the work of the particles' stresses, now that they have deformed.
    pub(crate) fn account_for_deformation(&mut self) {
        if let Some(budget) = &mut self.energy_budget {
            let mut sum = StressWork::default();
            for (work, volume) in self.stress_works.iter().zip(&self.particles.reference_volumes) {
                sum.viscous += work.viscous * volume;
                sum.stored_beyond += work.stored_beyond * volume;
            }
            budget.viscous += sum.viscous;
            budget.time_integration -= sum.stored_beyond;
        }
        self.stress_works.clear();
    }
}

/// What becomes of the nodes in a step.
#[derive(Default)]
pub(crate) struct Stages<const D: usize> {
    /// Their velocities at several moments.
    velocities: Vec<Vec<[f64; D]>>,
    /// Impulses of the boundary's forces.
    pushed: Vec<[f64; D]>,
}

impl<const D: usize> Stages<D> {
    fn push<N: GridNode<D>>(&mut self, nodes: &[N], velocity: impl Fn(&N) -> &[f64; D]) {
        self.velocities.push(nodes.iter().map(|node| *velocity(node)).collect());
    }
}
