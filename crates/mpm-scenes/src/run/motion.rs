//! A body on its way, whatever its basis and transfer: compiled once per dimension.

use mpm_core::{Basis, Boundaries, Continuum, Medium, Mpm, MpmError, Particles, StepControl, StepReport, Transfer};

use super::basis::SecondMoments;
use crate::law::{LawState, Laws};
use crate::loads::Loads;

/// What the loop over steps needs of a body.
pub(super) trait Motion<const D: usize> {
    /// The particles in their present order.
    fn particles(&self) -> &Particles<D, LawState>;

    /// Exchanges the particles, as after a checkpoint.
    fn set_particles(&mut self, particles: Particles<D, LawState>);

    /// The laws.
    fn laws(&self) -> &Laws;

    /// The forces.
    fn loads(&self) -> &Loads<D>;

    /// Walls and obstacles.
    fn boundaries_mut(&mut self) -> &mut Boundaries<D>;

    /// Time t.
    fn time(&self) -> f64;

    /// Puts the clock right.
    fn set_time(&mut self, time: f64);

    /// Spacing of the grid.
    fn spacing(&self) -> f64;

    /// Largest wave speed of the particles.
    fn wave_speed(&self) -> Result<f64, MpmError>;

    /// The diagonal of D_p at x, where the transfer is affine.
    fn second_moments(&self, x: &[f64; D]) -> Option<[f64; D]>;

    /// One step.
    fn step(&mut self, control: &StepControl) -> Result<StepReport, MpmError>;
}

impl<const D: usize, B, T> Motion<D> for Mpm<D, B, T, Continuum<Laws>, Loads<D>, Boundaries<D>>
where
    B: Basis<D> + SecondMoments<D>,
    T: Transfer<D>,
{
    fn particles(&self) -> &Particles<D, LawState> {
        &self.particles
    }

    fn set_particles(&mut self, particles: Particles<D, LawState>) {
        self.particles = particles;
    }

    fn laws(&self) -> &Laws {
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

    fn second_moments(&self, x: &[f64; D]) -> Option<[f64; D]> {
        T::AFFINE.then(|| self.basis.second_moments(x))
    }

    fn step(&mut self, control: &StepControl) -> Result<StepReport, MpmError> {
        Mpm::step(self, control)
    }
}
