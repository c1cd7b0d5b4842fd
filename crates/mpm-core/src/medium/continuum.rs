use mpm_materials::Law;
use mpm_tensor::Matrix;
use rayon::prelude::*;

use super::Medium;
use crate::largest::larger_or_nan;
use crate::{MpmError, Particles};

/// A continuum with a constitutive law: τ_p from F_p, internal variables and, for laws that depend on it, the velocity
/// gradient.
#[derive(Clone, Copy, Debug)]
pub struct Continuum<L> {
    /// The constitutive law.
    pub law: L,
}

impl<L> Continuum<L> {
    /// Wave speed c of a particle, and its density m_p / V⁰_p.
    #[inline]
    fn wave_speed_of<const D: usize>(&self, particles: &Particles<D, L::State>, particle: usize) -> (f64, f64)
    where
        L: Law<D>,
    {
        let density = particles.masses.get(particle) / particles.reference_volumes[particle];
        let (deformation, state) = (&particles.deformation_gradients[particle], &particles.states[particle]);
        (self.law.wave_speed(deformation, state, density), density)
    }

    /// Why a particle has no finite wave speed.
    fn fault<const D: usize>(&self, particles: &Particles<D, L::State>, particle: usize) -> MpmError
    where
        L: Law<D>,
    {
        match self.law.check(&particles.deformation_gradients[particle]) {
            Err(source) => MpmError::Deformation { particle, source },
            Ok(()) => {
                let (wave_speed, reference_density) = self.wave_speed_of(particles, particle);
                MpmError::WaveSpeed {
                    particle,
                    wave_speed,
                    reference_density,
                }
            }
        }
    }
}

impl<const D: usize, L: Law<D>> Medium<D> for Continuum<L> {
    type Impulse = Matrix<D>;
    type State = L::State;
    const DEFORMS: bool = true;

    fn rate_dependent(&self) -> bool {
        self.law.rate_dependent()
    }

    #[inline]
    fn impulse(&self, particles: &Particles<D, L::State>, particle: usize, time_step: f64) -> Matrix<D> {
        let rate = particles.velocity_gradients.get(particle).unwrap_or(&Matrix::ZERO);
        let (deformation, state) = (&particles.deformation_gradients[particle], &particles.states[particle]);
        let stress = self.law.kirchhoff_stress(deformation, state, rate);
        stress * (-time_step * particles.reference_volumes[particle])
    }

    #[inline]
    fn advance(&self, trial: &Matrix<D>, state: &mut L::State) -> Matrix<D> {
        self.law.advance(trial, state)
    }

    #[inline]
    fn volume_ratio(&self, deformation_gradient: &Matrix<D>, state: &L::State) -> f64 {
        self.law.volume_ratio(deformation_gradient, state)
    }

    /// A law gives a wave speed that is not finite wherever it has no stress, so the check costs nothing.
    fn wave_speed(&self, particles: &Particles<D, L::State>) -> Result<f64, MpmError> {
        let speed = |particle| self.wave_speed_of(particles, particle).0;
        let each = (0..particles.len()).into_par_iter().with_min_len(4096);
        let largest = each.map(speed).reduce(|| 0.0, larger_or_nan);
        if largest.is_finite() {
            return Ok(largest);
        }
        let at_fault = (0..particles.len()).find(|&particle| !speed(particle).is_finite());
        at_fault.map_or(Ok(0.0), |particle| Err(self.fault(particles, particle)))
    }
}
