use mpm_tensor::Matrix;

use super::Divide;
use crate::{Particles, StressWork};

/// The fields that grid → particles writes.
pub struct Moving<'a, const D: usize, S> {
    pub positions: &'a mut [[f64; D]],
    pub velocities: &'a mut [[f64; D]],
    pub affine: &'a mut [Matrix<D>],
    pub deformation_gradients: &'a mut [Matrix<D>],
    pub velocity_gradients: &'a mut [Matrix<D>],
    pub states: &'a mut [S],
    /// What becomes of the work of their stresses; empty where nobody asks.
    pub stress_works: &'a mut [StressWork],
}

/// Those of one particle.
pub struct MovingParticle<'a, const D: usize, S> {
    pub position: &'a mut [f64; D],
    pub velocity: &'a mut [f64; D],
    pub affine: Option<&'a mut Matrix<D>>,
    /// With its internal variables.
    pub deformation: Option<(&'a mut Matrix<D>, &'a mut S)>,
    pub velocity_gradient: Option<&'a mut Matrix<D>>,
    pub work: Option<&'a mut StressWork>,
}

impl<const D: usize, S> Moving<'_, D, S> {
    /// The fields of particle k. Asked for before the nodes are read: a check of a length in between would tear the work on them apart.
    #[inline(always)]
    pub fn particle(&mut self, k: usize, affine: bool, deforms: bool) -> MovingParticle<'_, D, S> {
        MovingParticle {
            position: &mut self.positions[k],
            velocity: &mut self.velocities[k],
            affine: if affine { Some(&mut self.affine[k]) } else { None },
            deformation: if deforms {
                Some((&mut self.deformation_gradients[k], &mut self.states[k]))
            } else {
                None
            },
            velocity_gradient: if deforms {
                self.velocity_gradients.get_mut(k)
            } else {
                None
            },
            work: if deforms { self.stress_works.get_mut(k) } else { None },
        }
    }
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
            stress_works: &mut [],
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
        let (stress_works, right_stress_works) = self.stress_works.divide(count);
        let left = Self {
            positions,
            velocities,
            affine,
            deformation_gradients,
            velocity_gradients,
            states,
            stress_works,
        };
        let right = Self {
            positions: right_positions,
            velocities: right_velocities,
            affine: right_affine,
            deformation_gradients: right_deformation_gradients,
            velocity_gradients: right_velocity_gradients,
            states: right_states,
            stress_works: right_stress_works,
        };
        (left, right)
    }
}
