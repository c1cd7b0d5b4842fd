use super::Medium;
use crate::Particles;

/// Isothermal gas: P = κρ, so V_p P_p = κ m_p and the internal force κ Σ_p m_p ∇w_ip needs neither F nor J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gas {
    /// κ, pressure per density (square of the isothermal speed of sound).
    pub pressure_per_density: f64,
}

impl<const D: usize> Medium<D> for Gas {
    type Impulse = f64;
    const DEFORMS: bool = false;

    #[inline(always)]
    fn impulse(&self, particles: &Particles<D>, particle: usize, time_step: f64) -> f64 {
        time_step * self.pressure_per_density * particles.masses.get(particle)
    }

    fn wave_speed(&self, _: &Particles<D>) -> f64 {
        self.pressure_per_density.sqrt()
    }
}
