use mpm_tensor::Matrix;

use super::Divide;
use crate::Particles;

/// The fields that the grid-to-particle transfer writes.
pub struct Moving<'a, const D: usize> {
    pub positions: &'a mut [[f64; D]],
    pub velocities: &'a mut [[f64; D]],
    pub affine: &'a mut [Matrix<D>],
    pub deformation_gradients: &'a mut [Matrix<D>],
}

impl<'a, const D: usize> Moving<'a, D> {
    pub fn of(particles: &'a mut Particles<D>) -> Self {
        Self {
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            affine: &mut particles.affine,
            deformation_gradients: &mut particles.deformation_gradients,
        }
    }
}

impl<const D: usize> Divide for Moving<'_, D> {
    fn divide(self, count: usize) -> (Self, Self) {
        let (positions, right_positions) = self.positions.divide(count);
        let (velocities, right_velocities) = self.velocities.divide(count);
        let (affine, right_affine) = self.affine.divide(count);
        let (deformation_gradients, right_deformation_gradients) = self.deformation_gradients.divide(count);
        let left = Self {
            positions,
            velocities,
            affine,
            deformation_gradients,
        };
        let right = Self {
            positions: right_positions,
            velocities: right_velocities,
            affine: right_affine,
            deformation_gradients: right_deformation_gradients,
        };
        (left, right)
    }
}
