//! One step of the material point method, phase by phase.

use mpm_tensor::vector;

use crate::diagnosis::{fault_of_velocity, is_finite, what_is_not_finite};
use crate::energy_budget::Stages;
use crate::friction::{slow_nodes, sum_up_impulses};
use crate::transfer::{GridNode, Transfer, advance};
use crate::{
    Basis, BodyForce, Boundary, Extents, ForceLocation, GridMotion, Loading, Medium, Mpm, MpmError, Particles, Sites,
    StepControl, StepReport, StressUpdate,
};

impl<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>, F: BodyForce<D>, C: Boundary<D>> Mpm<D, B, T, M, F, C> {
    /// One explicit step (symplectic Euler), as long as `control` allows.
    ///
    /// # Errors
    /// [`MpmError`]: limits or field lengths that make no sense, an inadmissible deformation, a position outside the grid's
    /// range, a force or a nodal velocity that is not finite, also of the boundary. The particles' state is then what it was, up to their order,
    /// but that a [`VelocityFilter`](crate::VelocityFilter) may have acted; with [`StressUpdate::First`] they may have deformed, too.
    pub fn step(&mut self, control: &StepControl) -> Result<StepReport, MpmError> {
        control.check()?;
        self.transfer.check()?;
        self.boundary.check()?;
        self.check_order()?;
        self.particles
            .check_lengths(T::AFFINE, M::DEFORMS, self.medium.rate_dependent())?;
        let h = self.basis.spacing();
        let dt = choose_time_step(&self.medium, &self.particles, control, h)?;
        self.particles.check_masses()?;
        let damping = control.damping(dt);

        self.basis.expect_affine_directions(T::AFFINE);
        rebuild(&mut self.basis, &mut self.particles)?;
        self.filter_velocities(dt);
        evaluate_particle_forces(
            &mut self.body_force,
            &self.particles,
            self.time,
            &mut self.accelerations,
        )?;
        self.deform_first(dt);
        let mut stages = self.velocities_brought(dt);
        self.particles_to_grid(dt);
        evaluate_node_forces(
            &mut self.body_force,
            &self.basis,
            self.nodes.as_slice(),
            &mut self.node_positions,
            &mut self.node_forces,
        )?;
        self.push_nodes(dt, &mut stages);
        let speed = self.update_grid(dt, damping, control.speed_limit(h, dt))?;
        self.record(&mut stages);
        self.press_on_surfaces((dt, damping), speed * dt)?;
        self.record(&mut stages);
        self.slow_by_friction();
        self.record(&mut stages);
        self.constrain_grid(dt);
        self.check_nodes()?;
        self.record(&mut stages);
        self.account(&stages, damping);
        self.update_particles(dt, damping);
        self.account_for_deformation();
        self.time += dt;
        Ok(StepReport {
            time_step: dt,
            active_nodes: self.basis.node_count(),
            displacement: speed * dt / h,
        })
    }

    /// Whether the body is told an order that its medium has.
    fn check_order(&self) -> Result<(), MpmError> {
        if M::ORDER_IS_FIXED && (self.stress_update != StressUpdate::Last || self.volume_averaging.acts()) {
            return Err(MpmError::InvalidParameter {
                field: "stress_update",
                value: f64::from(self.stress_update as u8),
                expected: "the last one (1), without averaged volumes, for a medium that deforms last",
            });
        }
        Ok(())
    }

    /// Deform the particles before forces are taken, where that is the order.
    fn deform_first(&mut self, dt: f64) {
        if !M::DEFORMS || M::ORDER_IS_FIXED {
            return;
        }
        if self.stress_update == StressUpdate::First {
            self.momentum_to_grid(dt);
            self.deform_particles(dt);
        }
    }

    /// Move the particles and, unless they have deformed already, deform them.
    fn update_particles(&mut self, dt: f64, damping: f64) {
        if !M::DEFORMS || M::ORDER_IS_FIXED {
            return self.move_and_deform_particles(dt, damping);
        }
        match self.stress_update {
            StressUpdate::First => self.move_particles(dt, damping),
            StressUpdate::Last if self.volume_averaging.acts() => {
                let start = self.particles.positions.clone();
                self.move_and_deform_particles(dt, damping);
                let moved = std::mem::replace(&mut self.particles.positions, start);
                self.average_volume_ratios();
                self.particles.positions = moved;
            }
            StressUpdate::Last => self.move_and_deform_particles(dt, damping),
            StressUpdate::ModifiedLast => {
                let start = self.particles.positions.clone();
                self.move_particles(dt, damping);
                let moved = std::mem::replace(&mut self.particles.positions, start);
                self.momentum_to_grid(dt);
                self.deform_particles(dt);
                self.particles.positions = moved;
            }
        }
    }

    /// Forget what nodes do not see of the velocities, where a filter is given and its time has come.
    fn filter_velocities(&mut self, dt: f64) {
        if let Some(filter) = &mut self.velocity_filter {
            let particles = &mut self.particles;
            filter.act(
                &self.basis,
                (self.time, dt),
                &particles.positions,
                &particles.masses,
                &mut particles.velocities,
            );
        }
    }

    /// v_i ← damping (v_i + Δt f_i / m_i), shortened to the limit; returns the largest speed before.
    fn update_grid(&mut self, dt: f64, damping: f64, speed_limit: f64) -> Result<f64, MpmError> {
        let pulled = self.body_force.location() == ForceLocation::Nodes;
        let forces = pulled.then_some((self.node_forces.as_slice(), dt));
        let square = advance(self.nodes.as_mut_slice(), forces, damping, speed_limit);
        if square.is_nan() {
            // Particles that deform first may have lost their stress in this step.
            let stressed = self.medium.wave_speed(&self.particles);
            stressed.map_err(|error| self.particles.name(error))?;
            self.basis.node_positions(&mut self.node_positions);
            let nodes = self.nodes.as_slice();
            return Err(what_is_not_finite(
                self.body_force.location(),
                &self.particles,
                &self.accelerations,
                (&self.node_positions, &self.node_forces),
                &|node| *nodes[node].velocity(),
            ));
        }
        Ok(square.sqrt())
    }

    /// The contact that is solved at the nodes, and what presses on them altogether if there is friction, both damped like all forces. No particle goes farther than `reach`.
    fn press_on_surfaces(&mut self, (dt, damping): (f64, f64), reach: f64) -> Result<(), MpmError> {
        let (particles, impulses) = (&self.particles, &mut self.normal_impulses);
        if let Some(friction) = self.body_force.friction() {
            let (positions, masses) = (&particles.positions, &particles.masses);
            let force_step = dt * damping;
            sum_up_impulses(
                &self.basis,
                positions,
                masses,
                friction.normal_forces,
                force_step,
                impulses,
            );
        }
        if let Some(potential) = self.body_force.contact() {
            let sites = sites(particles, self.time);
            let mut add = |node: usize, impulse: [f64; D]| {
                if let Some(sum) = impulses.as_mut_slice().get_mut(node) {
                    vector::accumulate(&mut sum.0, 1.0, &impulse);
                }
            };
            let nodes = self.nodes.as_mut_slice();
            let acted = self
                .contact
                .act(&self.basis, potential, &sites, (dt, damping, reach), nodes, &mut add);
            acted.map_err(|error| particles.name(error))?;
        }
        Ok(())
    }

    /// Friction of what presses on the nodes.
    fn slow_by_friction(&mut self) {
        if let Some(friction) = self.body_force.friction() {
            slow_nodes(&friction, &self.normal_impulses, self.nodes.as_mut_slice());
        }
    }

    /// Impulses of the boundary's forces.
    fn push_nodes(&mut self, dt: f64, stages: &mut Stages<D>) {
        if !C::PRESENT {
            return;
        }
        self.record_impulses(stages, -1.0);
        let (medium, particles) = (&self.medium, &self.particles);
        let loading = Loading {
            extents: Extents {
                positions: &particles.positions,
                volume: &|p| volume(medium, particles, p),
            },
            time: self.time,
            time_step: dt,
            least_squares: T::MOVING_LEAST_SQUARES,
        };
        self.boundary.push(&self.basis, &loading, self.nodes.as_mut_slice());
        self.record_impulses(stages, 1.0);
    }

    /// Velocities of the nodes that walls and obstacles touch.
    pub(crate) fn constrain_grid(&mut self, dt: f64) {
        if C::PRESENT {
            self.basis.node_positions(&mut self.node_positions);
            let (medium, particles) = (&self.medium, &self.particles);
            let motion = GridMotion {
                positions: &self.node_positions,
                extents: Extents {
                    positions: &particles.positions,
                    volume: &|p| volume(medium, particles, p),
                },
                time: self.time,
                time_step: dt,
            };
            self.boundary.constrain(&self.basis, &motion, self.nodes.as_mut_slice());
        }
    }

    /// Whether the boundary has left all velocities finite.
    fn check_nodes(&self) -> Result<(), MpmError> {
        let nodes = self.nodes.as_slice();
        if C::PRESENT && !nodes.iter().all(|node| is_finite(node.velocity())) {
            return Err(fault_of_velocity(&self.node_positions, &|node| *nodes[node].velocity()));
        }
        Ok(())
    }
}

// What follows does not hang on all types of a body, and is compiled once for those that it hangs on; called once per step, it is not copied into it.

/// Δt, by the wave speed of the medium and the speed of the particles.
#[inline(never)]
fn choose_time_step<const D: usize, M: Medium<D>>(
    medium: &M,
    particles: &Particles<D, M::State>,
    control: &StepControl,
    h: f64,
) -> Result<f64, MpmError> {
    let wave_speed = medium.wave_speed(particles);
    let wave_speed = wave_speed.map_err(|error| particles.name(error))?;
    let speed = if control.courant.is_finite() {
        particles.largest_speed()
    } else {
        0.0 // no limit asks for it
    };
    control.next_time_step(h, wave_speed, speed)
}

/// Sort the particles by cell where they are far from it, and number the nodes they touch.
#[inline(never)]
fn rebuild<const D: usize, B: Basis<D>, S: Copy + Send + Sync>(
    basis: &mut B,
    particles: &mut Particles<D, S>,
) -> Result<(), MpmError> {
    basis
        .sort(&particles.positions)
        .map_err(|error| particles.name(error))?;
    let schedule = basis.schedule();
    if !schedule.keeps_order() {
        particles.reorder(schedule.order());
    }
    basis.activate(&particles.positions)
}

/// V_p by the law's ratio: det F is not that of plastic laws, which keep an elastic part of F.
fn volume<const D: usize, M: Medium<D>>(medium: &M, particles: &Particles<D, M::State>, p: usize) -> f64 {
    let deformed = particles.deformation_gradients.get(p).zip(particles.states.get(p));
    let ratio = deformed.map_or(1.0, |(deformation, state)| medium.volume_ratio(deformation, state));
    (particles.reference_volumes.get(p).copied().unwrap_or(0.0) * ratio).max(0.0)
}

/// The particles as forces see them.
fn sites<const D: usize, S: Copy + Send + Sync>(particles: &Particles<D, S>, time: f64) -> Sites<'_, D> {
    Sites {
        positions: &particles.positions,
        velocities: &particles.velocities,
        identities: particles.identities(),
        time,
    }
}

/// Force per unit mass at the particles.
#[inline(never)]
fn evaluate_particle_forces<const D: usize, F: BodyForce<D>, S: Copy + Send + Sync>(
    body_force: &mut F,
    particles: &Particles<D, S>,
    time: f64,
    accelerations: &mut Vec<[f64; D]>,
) -> Result<(), MpmError> {
    if body_force.location() == ForceLocation::Particles {
        accelerations.resize(particles.len(), [0.0; D]);
        body_force
            .at_particles(&sites(particles, time), accelerations)
            .map_err(|error| particles.name(error))?;
    }
    Ok(())
}

/// Force at the nodes themselves.
#[inline(never)]
fn evaluate_node_forces<const D: usize, F: BodyForce<D>, N: GridNode<D>>(
    body_force: &mut F,
    basis: &impl Basis<D>,
    nodes: &[N],
    positions: &mut Vec<[f64; D]>,
    forces: &mut Vec<[f64; D]>,
) -> Result<(), MpmError> {
    if body_force.location() == ForceLocation::Nodes {
        basis.node_positions(positions);
        forces.resize(nodes.len(), [0.0; D]);
        body_force.at_nodes(positions, &|i| nodes[i].mass(), forces)?;
    }
    Ok(())
}
