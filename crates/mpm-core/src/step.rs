//! One step of the material point method: rebuild, forces, particles → grid, grid update, grid → particles.

use mpm_kernels::Deposit;
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;
use rayon::prelude::*;

use crate::largest::larger_or_nan;
use crate::transfer::{GridNode, Moving, Transfer, gather};
use crate::{Basis, BodyForce, ForceLocation, Medium, Mpm, MpmError, StepControl, StepReport, StressImpulse};

impl<const D: usize, B, T, M, F> Mpm<D, B, T, M, F>
where
    B: Basis<D>,
    T: Transfer<D>,
    M: Medium<D>,
    F: BodyForce<D>,
{
    /// One explicit step (symplectic Euler), as long as `control` allows.
    ///
    /// # Errors
    /// [`MpmError`]: limits or field lengths that make no sense, an inadmissible deformation, a position outside the grid's
    /// range, a force or a nodal velocity that is not finite. The particles' state is then what it was, up to their order.
    pub fn step(&mut self, control: &StepControl) -> Result<StepReport, MpmError> {
        control.check()?;
        self.particles.check_lengths(T::AFFINE, M::DEFORMS)?;
        let h = self.basis.spacing();
        let dt = self.choose_time_step(control, h)?;
        let damping = control.damping(dt);

        self.rebuild()?;
        self.evaluate_particle_forces()?;
        self.particles_to_grid(dt);
        self.evaluate_node_forces()?;
        let speed = self.update_grid(dt, damping, control.speed_limit(h, dt))?;
        self.grid_to_particles(dt, damping);

        Ok(StepReport {
            time_step: dt,
            active_nodes: self.basis.node_count(),
            displacement: speed * dt / h,
        })
    }

    /// Δt, by the wave speed of the medium and the speed of the particles.
    fn choose_time_step(&self, control: &StepControl, h: f64) -> Result<f64, MpmError> {
        let wave_speed = self.medium.wave_speed(&self.particles);
        let wave_speed = wave_speed.map_err(|error| self.particles.name(error))?;
        let speed = if control.courant.is_finite() {
            self.particles.largest_speed()
        } else {
            0.0 // no limit asks for it
        };
        control.next_time_step(h, wave_speed, speed)
    }

    /// Sort the particles by cell and number the nodes they touch.
    fn rebuild(&mut self) -> Result<(), MpmError> {
        self.basis
            .sort(&self.particles.positions)
            .map_err(|error| self.particles.name(error))?;
        let schedule = self.basis.schedule();
        if !schedule.keeps_order() {
            self.particles.reorder(schedule.order());
        }
        self.basis.activate(&self.particles.positions)
    }

    /// Force per unit mass at the particles.
    fn evaluate_particle_forces(&mut self) -> Result<(), MpmError> {
        if self.body_force.location() == ForceLocation::Particles {
            self.accelerations.resize(self.particles.len(), [0.0; D]);
            self.body_force
                .at_particles(&self.particles.positions, &mut self.accelerations)
                .map_err(|error| self.particles.name(error))?;
        }
        Ok(())
    }

    /// P2G: m_i = Σ_p w_ip m_p; m_i v_i = Σ_p w_ip m_p [v_p + B_p D_p⁻¹ (x_i − x_p)] + Δt Σ_p (w_ip m_p g_p − V⁰_p τ_p ∇w_ip).
    fn particles_to_grid(&mut self, dt: f64) {
        let (particles, medium, basis) = (&self.particles, &self.medium, &self.basis);
        let (velocities, accelerations) = (&particles.velocities[..], &self.accelerations[..]);
        let pulled = self.body_force.location() == ForceLocation::Particles;
        self.nodes.scatter(basis, &particles.positions, move |p, x, stencil| {
            let mass = particles.masses.get(p);
            let momentum = velocities[p].map(|v| mass * v);
            let stress = medium.impulse(particles, p, dt);
            let mut value = Deposit {
                scalar: mass,
                vector: if T::INCREMENTAL { [0.0; D] } else { momentum },
            };
            if pulled {
                for a in 0..D {
                    value.vector[a] += dt * mass * accelerations[p][a];
                }
            }
            stress.for_each_deposit(basis, p, x, &value, |index, weight, deposit| {
                let node = stencil.node(index);
                node.add(deposit);
                if T::INCREMENTAL {
                    node.add_momentum(&momentum.map(|c| weight * c));
                }
            });
            if T::AFFINE {
                let affine = particles.affine[p] * mass;
                basis.for_each_node(p, x, |index, entry| {
                    let direction = basis.affine_direction(entry);
                    stencil.node(index).add_momentum(&affine.apply(&direction));
                });
            }
        });
    }

    /// Force at the nodes themselves.
    fn evaluate_node_forces(&mut self) -> Result<(), MpmError> {
        if self.body_force.location() == ForceLocation::Nodes {
            self.basis.node_positions(&mut self.node_positions);
            let nodes = self.nodes.as_slice();
            self.node_forces.resize(nodes.len(), [0.0; D]);
            self.body_force
                .at_nodes(&self.node_positions, |i| nodes[i].mass(), &mut self.node_forces)?;
        }
        Ok(())
    }

    /// v_i ← damping (v_i + Δt f_i / m_i), shortened to the limit; returns the largest speed before.
    fn update_grid(&mut self, dt: f64, damping: f64, speed_limit: f64) -> Result<f64, MpmError> {
        let forces = &self.node_forces;
        let pulled = self.body_force.location() == ForceLocation::Nodes;
        let advance = |(i, node): (usize, &mut T::Node)| {
            let impulse = if pulled { forces[i].map(|f| dt * f) } else { [0.0; D] };
            node.advance(&impulse, damping, speed_limit)
        };
        let nodes = self.nodes.as_mut_slice().par_iter_mut().with_min_len(4096).enumerate();
        let square = nodes.map(advance).reduce(|| 0.0, larger_or_nan);
        if square.is_nan() {
            return Err(self.what_is_not_finite());
        }
        Ok(square.sqrt())
    }

    /// G2P: v_p = Σ_i w_ip v_i, B_p = Σ_i w_ip v_i (x_i − x_p)ᵀ, F_p ← (I + Δt Σ_i v_i ∇w_ipᵀ) F_p, x_p ← x_p + Δt Σ_i w_ip v_i.
    fn grid_to_particles(&mut self, dt: f64, damping: f64) {
        let (basis, nodes, transfer) = (&self.basis, self.nodes.as_slice(), self.transfer);
        gather(
            basis,
            Moving::of(&mut self.particles),
            move |data: &mut Moving<D>, k, p, cell_nodes| {
                let x = data.positions[k];
                let (mut velocity, mut change) = ([0.0; D], [0.0; D]);
                let (mut affine, mut velocity_gradient) = (Matrix::<D>::ZERO, Matrix::<D>::ZERO);
                basis.for_each_node(p, &x, |index, entry| {
                    let node = &nodes[cell_nodes[index] as usize];
                    let v = node.velocity();
                    for a in 0..D {
                        velocity[a] = multiply_add(entry.weight, v[a], velocity[a]);
                    }
                    if T::INCREMENTAL {
                        let node_change = node.change(damping);
                        for a in 0..D {
                            change[a] += entry.weight * node_change[a];
                        }
                    }
                    if T::AFFINE {
                        add_outer(&mut affine, entry.weight, v, &entry.offset);
                    }
                    if M::DEFORMS {
                        add_outer(&mut velocity_gradient, 1.0, v, &entry.gradient);
                    }
                });
                data.velocities[k] = transfer.particle_velocity(&velocity, &change, &data.velocities[k], damping);
                for a in 0..D {
                    data.positions[k][a] = multiply_add(dt, velocity[a], x[a]);
                }
                if T::AFFINE {
                    data.affine[k] = affine;
                }
                if M::DEFORMS {
                    #[allow(non_snake_case)]
                    let F = &mut data.deformation_gradients[k];
                    *F = (Matrix::IDENTITY + velocity_gradient * dt) * *F;
                }
            },
        );
    }
}

/// `matrix` += scale a bᵀ.
#[inline(always)]
fn add_outer<const D: usize>(matrix: &mut Matrix<D>, scale: f64, a: &[f64; D], b: &[f64; D]) {
    for i in 0..D {
        for j in 0..D {
            matrix.0[i][j] += scale * a[i] * b[j];
        }
    }
}
