use mpm_materials::Material;
use mpm_tensor::Matrix;

use super::Medium;
use crate::Particles;

/// An elastic solid: τ_p from F_p by a constitutive law.
#[derive(Clone, Copy, Debug)]
pub struct Elastic<M> {
    /// The constitutive law.
    pub material: M,
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

    fn wave_speed(&self, particles: &Particles<D>) -> f64 {
        #[allow(non_snake_case)]
        let of_particle = |(p, F): (usize, &Matrix<D>)| {
            let density = particles.masses.get(p) / particles.reference_volumes[p];
            self.material.wave_speed(F, density)
        };
        let each = particles.deformation_gradients.iter().enumerate();
        each.map(of_particle).fold(0.0, f64::max)
    }
}
