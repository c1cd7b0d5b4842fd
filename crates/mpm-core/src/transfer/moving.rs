use mpm_tensor::Matrix;

use super::Divide;
use crate::Particles;

/// The fields that grid → particles writes.
pub struct Moving<'a, const D: usize, S> {
    pub positions: &'a mut [[f64; D]],
    pub velocities: &'a mut [[f64; D]],
    pub affine: &'a mut [Matrix<D>],
    pub deformation_gradients: &'a mut [Matrix<D>],
    pub velocity_gradients: &'a mut [Matrix<D>],
    pub states: &'a mut [S],
}

impl<'a, const D: usize, S> Moving<'a, D, S> {
    pub fn of(particles: &'a mut Particles<D, S>) -> Self {
        Self {
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            affine: &mut particles.affine,
            deformation_gradients: &mut particles.deformation_gradients,
            velocity_gradients: &mut particles.velocity_gradients,
            states: &mut particles.states,
        }
    }
}

impl<const D: usize, S: Send> Divide for Moving<'_, D, S> {
    fn divide(self, count: usize) -> (Self, Self) {
        let (positions, right_positions) = self.positions.divide(count);
        let (velocities, right_velocities) = self.velocities.divide(count);
        let (affine, right_affine) = self.affine.divide(count);
        let (deformation_gradients, right_deformation_gradients) = self.deformation_gradients.divide(count);
        let (velocity_gradients, right_velocity_gradients) = self.velocity_gradients.divide(count);
        let (states, right_states) = self.states.divide(count);
        let left = Self {
            positions,
            velocities,
            affine,
            deformation_gradients,
            velocity_gradients,
            states,
        };
        let right = Self {
            positions: right_positions,
            velocities: right_velocities,
            affine: right_affine,
            deformation_gradients: right_deformation_gradients,
            velocity_gradients: right_velocity_gradients,
            states: right_states,
        };
        (left, right)
    }
}
