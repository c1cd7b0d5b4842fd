use mpm_materials::IsothermalGas;

use super::Medium;
use crate::{MpmError, Particles};

/// P = κρ, so V_p P_p = κ m_p: the internal force κ Σ_p m_p ∇w_ip needs neither F nor J.
impl<const D: usize> Medium<D> for IsothermalGas {
    type Impulse = f64;
    type State = ();
    const DEFORMS: bool = false;

    #[inline(always)]
    fn impulse(&self, particles: &Particles<D>, particle: usize, time_step: f64) -> f64 {
        time_step * self.pressure_times_volume(particles.masses.get(particle))
    }

    fn wave_speed(&self, _: &Particles<D>) -> Result<f64, MpmError> {
        Ok(IsothermalGas::wave_speed(self))
    }
}
