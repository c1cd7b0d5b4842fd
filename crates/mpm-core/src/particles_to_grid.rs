//! Particles → grid: mass, momentum and the impulse of the stress.

use std::ops::Range;

use mpm_kernels::Deposit;
use mpm_tensor::vector::scale;

use crate::transfer::{CellSums, GridNode, NodeSums, Prepare, Transfer};
use crate::{Basis, BodyForce, Boundary, ForceLocation, Medium, Member, Mpm, Particles, StressImpulse};

/// −Δt V⁰_p τ_p of a medium that deforms.
struct Stresses<'a, M: Medium<D>, const D: usize> {
    particles: &'a Particles<D, M::State>,
    medium: &'a M,
    time_step: f64,
    /// Whether forces act; the stresses of a pass without are zero.
    forces: bool,
}

impl<M: Medium<D>, const D: usize> Clone for Stresses<'_, M, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Medium<D>, const D: usize> Copy for Stresses<'_, M, D> {}

impl<M: Medium<D>, const D: usize> Prepare for Stresses<'_, M, D> {
    type Value = M::Impulse;
    const WANTED: bool = M::DEFORMS;

    fn prepare(&self, range: Range<usize>, to: &mut Vec<M::Impulse>) {
        if self.forces {
            self.medium.impulses(self.particles, range, self.time_step, to);
        } else {
            to.clear();
            to.resize(range.len(), M::Impulse::ZERO);
        }
    }
}

/// Stresses are prepared for every particle; a constant in the place of this call would be a choice among numbers at each of them.
#[cold]
#[inline(never)]
fn unprepared<const D: usize, I: StressImpulse<D>>() -> I {
    I::ZERO
}

impl<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>, F: BodyForce<D>, C: Boundary<D>> Mpm<D, B, T, M, F, C> {
    /// P2G: m_i = Σ_p w_ip m_p; m_i v_i = Σ_p w_ip m_p [v_p + B_p D_p⁻¹ (x_i − x_p)] + Δt Σ_p (w_ip m_p g_p − V⁰_p τ_p ∇w_ip).
    ///
    /// Moving least squares have w_ip D_p⁻¹ (x_i − x_p) in the place of ∇w_ip.
    pub(crate) fn particles_to_grid(&mut self, dt: f64) {
        self.scatter(dt, true);
    }

    /// P2G with all forces, or with none.
    #[inline]
    fn scatter(&mut self, dt: f64, forces: bool) {
        let pulled = forces && self.body_force.location() == ForceLocation::Particles;
        let accelerations = pulled.then_some(self.accelerations.as_slice());
        let (particles, medium, nodes) = (&self.particles, &self.medium, &mut self.nodes);
        scatter::<D, B, T, M>(&self.basis, particles, medium, accelerations, nodes, (dt, forces));
    }

    /// The velocities of the nodes without any force: mass and momentum alone, then the boundary.
    pub(crate) fn momentum_to_grid(&mut self, dt: f64) {
        self.momentum_of_particles(dt);
        self.constrain_grid(dt);
    }

    /// The velocities v_iⁿ of the nodes that the particles bring.
    pub(crate) fn momentum_of_particles(&mut self, dt: f64) {
        self.scatter(dt, false);
        for node in self.nodes.as_mut_slice() {
            node.advance(&[0.0; D], 1.0, f64::INFINITY);
        }
    }
}

/// P2G over a time step, with all forces or with none; `accelerations` where a body force acts at the particles. Compiled once for all body forces and boundaries.
fn scatter<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>>(
    basis: &B,
    particles: &Particles<D, M::State>,
    medium: &M,
    accelerations: Option<&[[f64; D]]>,
    nodes: &mut NodeSums<T::Node>,
    (dt, forces): (f64, bool),
) {
    let velocities = &particles.velocities[..];
    let (pulled, accelerations) = (accelerations.is_some(), accelerations.unwrap_or_default());
    let stresses = Stresses {
        particles,
        medium,
        time_step: dt,
        forces,
    };
    let deposit = move |member: Member<B::Cell, D>, stress: Option<&M::Impulse>, cell: &mut CellSums<B, T::Node, D>| {
        let p = member.particle;
        let mass = particles.masses.get(p);
        let mut impulse = [0.0; D];
        if pulled {
            impulse = scale(&accelerations[p], dt * mass);
        }
        let stress = if M::DEFORMS {
            stress.copied().unwrap_or_else(unprepared)
        } else {
            medium.impulse(particles, p, dt)
        };
        let mut value = Deposit {
            scalar: mass,
            vector: scale(&velocities[p], mass),
        };
        if T::INCREMENTAL {
            let force = Deposit {
                scalar: 0.0,
                vector: impulse,
            };
            if T::AFFINE {
                let affine = particles.affine[p] * mass;
                basis.deposit(member, &value, &affine, &(), &mut cell.sums());
            } else {
                basis.deposit(member, &value, &(), &(), &mut cell.sums());
            }
            if forces {
                basis.deposit(member, &force, &(), &stress, &mut cell.impulses());
            }
            return;
        }
        for a in 0..D {
            value.vector[a] += impulse[a];
        }
        if T::MOVING_LEAST_SQUARES {
            let affine = particles.affine[p] * mass + stress.matrix();
            basis.deposit(member, &value, &affine, &(), &mut cell.sums());
        } else if T::AFFINE {
            let affine = particles.affine[p] * mass;
            basis.deposit(member, &value, &affine, &stress, &mut cell.sums());
        } else {
            basis.deposit(member, &value, &(), &stress, &mut cell.sums());
        }
    };
    nodes.scatter_packed(basis, &particles.positions, T::INCREMENTAL, stresses, deposit);
}
