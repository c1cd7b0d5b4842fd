use mpm_materials::Material;
use mpm_tensor::Matrix;
use rayon::prelude::*;

use super::Medium;
use crate::largest::larger_or_nan;
use crate::{MpmError, Particles};

/// An elastic solid: τ_p from F_p by a constitutive law.
#[derive(Clone, Copy, Debug)]
pub struct Elastic<M> {
    /// The constitutive law.
    pub material: M,
}

impl<M> Elastic<M> {
    /// Wave speed c of a particle, and its density m_p / V⁰_p.
    #[inline]
    fn wave_speed_of<const D: usize>(&self, particles: &Particles<D>, particle: usize) -> (f64, f64)
    where
        M: Material<D>,
    {
        let density = particles.masses.get(particle) / particles.reference_volumes[particle];
        let speed = self
            .material
            .wave_speed(&particles.deformation_gradients[particle], density);
        (speed, density)
    }

    /// Why a particle has no finite wave speed.
    fn fault<const D: usize>(&self, particles: &Particles<D>, particle: usize) -> MpmError
    where
        M: Material<D>,
    {
        match self.material.check(&particles.deformation_gradients[particle]) {
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

impl<const D: usize, M: Material<D>> Medium<D> for Elastic<M> {
    type Impulse = Matrix<D>;
    const DEFORMS: bool = true;

    #[inline]
    fn impulse(&self, particles: &Particles<D>, particle: usize, time_step: f64) -> Matrix<D> {
        let stress = self
            .material
            .kirchhoff_stress(&particles.deformation_gradients[particle]);
        stress * (-time_step * particles.reference_volumes[particle])
    }

    /// A law gives a wave speed that is not finite wherever it has no stress, so the check costs nothing.
    fn wave_speed(&self, particles: &Particles<D>) -> Result<f64, MpmError> {
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
