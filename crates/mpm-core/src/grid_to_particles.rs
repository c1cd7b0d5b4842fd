//! Grid → particles: particles move and deform with the nodes around them.

use mpm_kernels::{Interpolated, Wanted};
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

use crate::deformation::{Deformation, deform};
use crate::transfer::{
    CellField, Changes, GridNode, Moving, MovingParticle, Numbered, Transfer, Velocities, gather_cells,
};
use crate::volume_averaging::{average_volume_ratios, keep_deformations};
use crate::{Basis, BodyForce, Boundary, Medium, Member, Mpm};

/// Of the nodal velocities, around a particle: interpolated, and its moment where that is asked for.
type Change<const D: usize> = ([f64; D], Matrix<D>);

impl<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>, F: BodyForce<D>, C: Boundary<D>> Mpm<D, B, T, M, F, C> {
    /// v_p = Σ_i w_ip v_i, B_p = Σ_i w_ip v_i (x_i − x_p)ᵀ, x_p ← x_p + Δt Σ_i w_ip v_i; in the same pass, where the medium deforms,
    /// F_p ← (I + Δt Σ_i v_i ∇w_ipᵀ) F_p, then whatever the medium admits of it.
    pub(crate) fn move_and_deform_particles(&mut self, dt: f64, damping: f64) {
        keep_deformations(self.volume_averaging, &self.particles, &mut self.deformations_before);
        let mut moving = Moving::of(&mut self.particles);
        moving.stress_works = &mut self.stress_works;
        let (transfer, deformation) = (
            self.transfer.over(dt),
            Deformation::of(&self.medium, dt, !self.volume_averaging.acts()),
        );
        let nodes = self.nodes.as_slice();
        advect::<true, D, B, T, M>(&self.basis, nodes, moving, transfer, deformation, damping);
    }

    /// [`move_and_deform_particles`](Self::move_and_deform_particles) without the deformation.
    pub(crate) fn move_particles(&mut self, dt: f64, damping: f64) {
        let moving = Moving::of(&mut self.particles);
        let (transfer, deformation) = (self.transfer.over(dt), Deformation::of(&self.medium, dt, true));
        let nodes = self.nodes.as_slice();
        advect::<false, D, B, T, M>(&self.basis, nodes, moving, transfer, deformation, damping);
    }

    /// [`move_and_deform_particles`](Self::move_and_deform_particles) without the motion.
    pub(crate) fn deform_particles(&mut self, dt: f64) {
        keep_deformations(self.volume_averaging, &self.particles, &mut self.deformations_before);
        let nodes = T::Node::velocities_alone(self.nodes.as_slice());
        let moving = Moving::of(&mut self.particles);
        let deformation = Deformation::of(&self.medium, dt, !self.volume_averaging.acts());
        if T::MOVING_LEAST_SQUARES {
            deform::<true, D, B, M>(&self.basis, &nodes, moving, deformation);
        } else {
            deform::<false, D, B, M>(&self.basis, &nodes, moving, deformation);
        }
        if self.volume_averaging.acts() {
            self.average_volume_ratios();
        }
    }

    /// The second half of a deformation with averaged volumes, at the positions that the basis was activated with.
    #[inline]
    pub(crate) fn average_volume_ratios(&mut self) {
        let (before, nodes) = (&self.deformations_before, &mut self.node_volumes);
        average_volume_ratios(&self.basis, &self.medium, &mut self.particles, before, nodes);
    }
}

/// G2P of particles that move, and `DEFORM` where that is said. Compiled once for all body forces and boundaries.
///
/// One pass that computes everything and writes a part is compiled sooner, but made the modified order on a mesh a fifth slower.
fn advect<const DEFORM: bool, const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>>(
    basis: &B,
    nodes: &[T::Node],
    moving: Moving<D, M::State>,
    transfer: T,
    deformation: Deformation<M>,
    damping: f64,
) {
    let (dt, takes_moments, adds_moments) = (deformation.time_step, transfer.takes_moments(), transfer.adds_moments());
    let velocity = Velocities::<_, D>(nodes);
    let change = Changes::<_, D> { nodes, damping };
    let update = move |mut particle: MovingParticle<D, M::State>, seen: &Interpolated<D>, change: &Change<D>| {
        *particle.velocity = transfer.particle_velocity(&seen.value, &change.0, particle.velocity, damping);
        for a in 0..D {
            particle.position[a] = multiply_add(dt, seen.value[a], particle.position[a]);
        }
        if let (true, Some(affine)) = (takes_moments, particle.affine.take()) {
            *affine = transfer.particle_moment(&seen.moment, &change.1, affine, damping);
        }
        deformation.apply(particle, &seen.gradient);
    };
    gather_cells(
        basis,
        moving,
        move |data: &mut Moving<D, M::State>, work, first, (collected, fields): &mut (B::Cell, [CellField; 2])| {
            // In here and not captured, so that they are known when this is compiled.
            let deforms = DEFORM && M::DEFORMS;
            let wanted = Wanted {
                gradient: deforms,
                least_squares: T::MOVING_LEAST_SQUARES,
                moment: T::AFFINE,
            };
            let (numbers, size, value) = (work.nodes, work.nodes.len(), Wanted::default());
            let [velocities, changes] = fields;
            if !B::LONE_PARTICLES {
                velocities.collect_entering(basis, (work.cell, collected), numbers, velocity);
                if T::INCREMENTAL {
                    changes.collect(basis, numbers, change);
                }
            }
            for p in work.particles {
                let particle = data.particle(p - first, T::AFFINE, deforms);
                let x = *particle.position;
                let member = Member {
                    cell: collected,
                    particle: p,
                    x: &x,
                };
                let mut changed = ([0.0; D], Matrix::ZERO);
                let moments = Wanted {
                    moment: T::AFFINE,
                    ..value
                };
                let seen = if B::LONE_PARTICLES {
                    if T::INCREMENTAL {
                        let changes = Numbered { field: change, numbers };
                        changed.0 = basis.interpolate(member, value, &changes).value;
                        if T::AFFINE && adds_moments {
                            changed.1 = basis.interpolate(member, moments, &changes).moment;
                        }
                    }
                    basis.interpolate(
                        member,
                        wanted,
                        &Numbered {
                            field: velocity,
                            numbers,
                        },
                    )
                } else {
                    if T::INCREMENTAL {
                        let changes = changes.nodes(basis, size);
                        changed.0 = basis.interpolate(member, value, &changes).value;
                        if T::AFFINE && adds_moments {
                            changed.1 = basis.interpolate(member, moments, &changes).moment;
                        }
                    }
                    basis.interpolate(member, wanted, &velocities.nodes(basis, size))
                };
                update(particle, &seen, &changed);
            }
        },
    );
}
