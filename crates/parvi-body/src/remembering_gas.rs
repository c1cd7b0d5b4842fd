//! The gas as a medium for particles that could remember something.

use mpm_core::{Medium, MpmError};
use mpm_materials::{IsothermalGas, Memory};

use crate::moving::Cloud;

/// The isothermal gas, with the type of internal variables that bodies of all media share; it has none of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RememberingGas(pub IsothermalGas);

impl<const D: usize> Medium<D> for RememberingGas {
    type Impulse = f64;
    type State = Memory;
    const DEFORMS: bool = false;

    #[inline(always)]
    fn impulse(&self, particles: &Cloud<D>, particle: usize, time_step: f64) -> f64 {
        time_step * self.0.pressure_times_volume(particles.masses.get(particle))
    }

    fn wave_speed(&self, _: &Cloud<D>) -> Result<f64, MpmError> {
        Ok(self.0.wave_speed())
    }
}
