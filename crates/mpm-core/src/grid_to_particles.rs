//! Grid → particles: particles move and deform with the nodes around them.

use mpm_kernels::{Interpolated, Wanted, deformed};
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

use crate::transfer::{CellField, Changes, Moving, MovingParticle, Numbered, Transfer, Velocities, gather_cells};
use crate::volume_averaging::average_volume_ratios;
use crate::{Basis, BodyForce, Boundary, Medium, Member, Mpm};

/// Of the nodal velocities, around a particle: interpolated, and its moment where that is asked for.
type Change<const D: usize> = ([f64; D], Matrix<D>);

impl<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>, F: BodyForce<D>, C: Boundary<D>> Mpm<D, B, T, M, F, C> {
    /// v_p = Σ_i w_ip v_i, B_p = Σ_i w_ip v_i (x_i − x_p)ᵀ, x_p ← x_p + Δt Σ_i w_ip v_i; in the same pass, where the medium deforms,
    /// F_p ← (I + Δt Σ_i v_i ∇w_ipᵀ) F_p, then whatever the medium admits of it.
    pub(crate) fn move_and_deform_particles(&mut self, dt: f64, damping: f64) {
        self.grid_to_particles::<true, true>(dt, damping);
    }

    /// [`move_and_deform_particles`](Self::move_and_deform_particles) without the deformation.
    pub(crate) fn move_particles(&mut self, dt: f64, damping: f64) {
        self.grid_to_particles::<true, false>(dt, damping);
    }

    /// [`move_and_deform_particles`](Self::move_and_deform_particles) without the motion.
    pub(crate) fn deform_particles(&mut self, dt: f64) {
        self.grid_to_particles::<false, true>(dt, 1.0);
        if self.volume_averaging {
            self.average_volume_ratios();
        }
    }

    /// The second half of a deformation with averaged volumes, at the positions that the basis was activated with.
    pub(crate) fn average_volume_ratios(&mut self) {
        let nodes = &mut self.node_volumes;
        average_volume_ratios(&self.basis, &self.medium, &mut self.particles, nodes);
    }

    /// G2P. With volume averaging the trial deformation gradient is left for [`average_volume_ratios`].
    ///
    /// One pass that computes everything and writes a part is compiled sooner, but made the modified order on a mesh a fifth slower.
    fn grid_to_particles<const MOVE: bool, const DEFORM: bool>(&mut self, dt: f64, damping: f64) {
        let (basis, nodes, transfer) = (&self.basis, self.nodes.as_slice(), self.transfer.over(dt));
        let (medium, admit) = (&self.medium, !self.volume_averaging);
        let mut moving = Moving::of(&mut self.particles);
        if MOVE && DEFORM {
            moving.excesses = &mut self.excesses;
        }
        let (rate_dependent, takes_moments) = (medium.rate_dependent(), transfer.takes_moments());
        let adds_moments = transfer.adds_moments();
        let velocity = Velocities::<_, D>(nodes);
        let change = Changes::<_, D> { nodes, damping };
        let update = move |particle: MovingParticle<D, M::State>, seen: &Interpolated<D>, change: &Change<D>| {
            if MOVE {
                *particle.velocity = transfer.particle_velocity(&seen.value, &change.0, particle.velocity, damping);
                for a in 0..D {
                    particle.position[a] = multiply_add(dt, seen.value[a], particle.position[a]);
                }
                if let (true, Some(affine)) = (takes_moments, particle.affine) {
                    *affine = transfer.particle_moment(&seen.moment, &change.1, affine, damping);
                }
            }
            #[allow(non_snake_case)]
            if let Some((F, state)) = particle.deformation {
                let trial = deformed(F, &seen.gradient, dt);
                if let Some(excess) = particle.excess {
                    let before = particle.velocity_gradient.as_deref().unwrap_or(&Matrix::ZERO);
                    *excess = medium.stored_beyond_work([F, &trial], &(seen.gradient * dt), state, before);
                }
                *F = if admit { medium.advance(&trial, state) } else { trial };
                if let (true, Some(velocity_gradient)) = (rate_dependent, particle.velocity_gradient) {
                    *velocity_gradient = seen.gradient;
                }
            }
        };
        gather_cells(
            basis,
            moving,
            move |data: &mut Moving<D, M::State>, work, first, (collected, fields): &mut (B::Cell, [CellField; 2])| {
                // In here and not captured, so that they are known when this is compiled.
                let incremental = MOVE && T::INCREMENTAL;
                let (affine, deforms) = (MOVE && T::AFFINE, DEFORM && M::DEFORMS);
                let wanted = Wanted {
                    gradient: deforms,
                    least_squares: T::MOVING_LEAST_SQUARES,
                    moment: affine,
                };
                let (numbers, size, value) = (work.nodes, work.nodes.len(), Wanted::default());
                basis.enter(work.cell, collected);
                let [velocities, changes] = fields;
                if !B::LONE_PARTICLES {
                    velocities.collect(basis, numbers, velocity);
                    if incremental {
                        changes.collect(basis, numbers, change);
                    }
                }
                for p in work.particles {
                    let particle = data.particle(p - first, affine, deforms);
                    let x = *particle.position;
                    let member = Member {
                        cell: collected,
                        particle: p,
                        x: &x,
                    };
                    let mut changed = ([0.0; D], Matrix::ZERO);
                    let moments = Wanted {
                        moment: affine,
                        ..value
                    };
                    let seen = if B::LONE_PARTICLES {
                        if incremental {
                            let changes = Numbered { field: change, numbers };
                            changed.0 = basis.interpolate(member, value, &changes).value;
                            if affine && adds_moments {
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
                        if incremental {
                            let changes = changes.nodes(basis, size);
                            changed.0 = basis.interpolate(member, value, &changes).value;
                            if affine && adds_moments {
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
}
