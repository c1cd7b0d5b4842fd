//! A body on its way, whatever its basis and transfer: compiled once per dimension.

use mpm_core::{
    Boundaries, Continuum, EnergyBudget, Medium, Mpm, MpmError, Particles, StepControl, StepReport, Transfer,
};
use mpm_tensor::Matrix;

use super::basis::SecondMoments;
use crate::Kinematics;
use crate::law::{LawState, Laws};
use crate::loads::Loads;

/// What the loop over steps needs of a body.
pub(super) trait Motion<const D: usize> {
    /// The particles in their present order.
    fn particles(&self) -> &Particles<D, LawState>;

    /// Sets an internal variable of the particle at this place by its name; nothing where its law has no such one.
    fn set_internal_variable(&mut self, index: usize, name: &str, value: f64);

    /// Exchanges the particles, as after a checkpoint.
    fn set_particles(&mut self, particles: Particles<D, LawState>);

    /// The laws.
    fn laws(&self) -> &Laws<D>;

    /// The forces.
    fn loads(&self) -> &Loads<D>;

    /// Walls and obstacles.
    fn boundaries_mut(&mut self) -> &mut Boundaries<D>;

    /// Time t.
    fn time(&self) -> f64;

    /// Puts the clock right.
    fn set_time(&mut self, time: f64);

    /// Length that the time step is measured by: the spacing of the grid, or the shortest edge of the mesh.
    fn spacing(&self) -> f64;

    /// Largest wave speed of the particles.
    fn wave_speed(&self) -> Result<f64, MpmError>;

    /// Whether the transfer is affine.
    fn is_affine(&self) -> bool;

    /// D_p⁻¹ at x.
    fn inverse_moment(&self, x: &[f64; D]) -> Matrix<D>;

    /// Gives kinematic particles the position and velocity that they have at this time; `reference` has X in the order of creation.
    fn prescribe(&mut self, kinematics: &Kinematics<D>, reference: &[[f64; D]]);

    /// What the nodes' kinetic energy has gained; none unless it was asked for.
    fn energy_budget(&self) -> Option<EnergyBudget>;

    /// As [`energy_budget`](Self::energy_budget), to ask for it or to put it right.
    fn energy_budget_mut(&mut self) -> &mut Option<EnergyBudget>;

    /// One step.
    fn step(&mut self, control: &StepControl) -> Result<StepReport, MpmError>;
}

impl<const D: usize, B, T> Motion<D> for Mpm<D, B, T, Continuum<Laws<D>>, Loads<D>, Boundaries<D>>
where
    B: SecondMoments<D>,
    T: Transfer<D>,
{
    fn particles(&self) -> &Particles<D, LawState> {
        &self.particles
    }

    fn set_internal_variable(&mut self, index: usize, name: &str, value: f64) {
        self.medium
            .law
            .set_internal_variable(&mut self.particles.states[index], name, value);
    }

    fn set_particles(&mut self, particles: Particles<D, LawState>) {
        self.particles = particles;
    }

    fn laws(&self) -> &Laws<D> {
        &self.medium.law
    }

    fn loads(&self) -> &Loads<D> {
        &self.body_force
    }

    fn boundaries_mut(&mut self) -> &mut Boundaries<D> {
        &mut self.boundary
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn spacing(&self) -> f64 {
        self.basis.spacing()
    }

    fn wave_speed(&self) -> Result<f64, MpmError> {
        self.medium.wave_speed(&self.particles)
    }

    fn is_affine(&self) -> bool {
        T::AFFINE
    }

    fn inverse_moment(&self, x: &[f64; D]) -> Matrix<D> {
        self.basis.inverse_moment(x)
    }

    fn prescribe(&mut self, kinematics: &Kinematics<D>, reference: &[[f64; D]]) {
        if kinematics.regions().is_empty() {
            return;
        }
        for index in 0..self.particles.len() {
            let particle = self.particles.identity(index);
            let start = reference.get(particle);
            let state = start.and_then(|start| kinematics.prescribed(particle, start, self.time));
            if let Some((position, velocity)) = state {
                self.particles.positions[index] = position;
                self.particles.velocities[index] = velocity;
            }
        }
    }

    fn energy_budget(&self) -> Option<EnergyBudget> {
        self.energy_budget
    }

    fn energy_budget_mut(&mut self) -> &mut Option<EnergyBudget> {
        &mut self.energy_budget
    }

    fn step(&mut self, control: &StepControl) -> Result<StepReport, MpmError> {
        Mpm::step(self, control)
    }
}
