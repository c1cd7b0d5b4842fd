use std::ops::Range;

use mpm_tensor::Matrix;

use super::{Medium, StressWork};
use crate::{MpmError, Particles};

/// A medium whose particles deform in the pass that moves them, without averaged volumes: the default of a step
/// ([`StressUpdate::Last`](crate::StressUpdate::Last)) and nothing else, so that no other order is compiled for it. A step that is told
/// otherwise is refused.
#[derive(Clone, Copy, Debug)]
pub struct DeformsLast<M>(
    /// What it is made of.
    pub M,
);

impl<const D: usize, M: Medium<D>> Medium<D> for DeformsLast<M> {
    type Impulse = M::Impulse;
    type State = M::State;
    const DEFORMS: bool = M::DEFORMS;
    const ORDER_IS_FIXED: bool = true;

    fn rate_dependent(&self) -> bool {
        self.0.rate_dependent()
    }

    #[inline(always)]
    fn impulse(&self, particles: &Particles<D, M::State>, particle: usize, time_step: f64) -> M::Impulse {
        self.0.impulse(particles, particle, time_step)
    }

    fn impulses(
        &self,
        particles: &Particles<D, M::State>,
        range: Range<usize>,
        time_step: f64,
        impulses: &mut Vec<M::Impulse>,
    ) {
        self.0.impulses(particles, range, time_step, impulses);
    }

    #[inline(always)]
    fn advance(&self, trial: &Matrix<D>, state: &mut M::State) -> Matrix<D> {
        self.0.advance(trial, state)
    }

    fn stress_work(
        &self,
        deformations: [&Matrix<D>; 2],
        way: &Matrix<D>,
        state: &M::State,
        velocity_gradient: &Matrix<D>,
    ) -> StressWork {
        self.0.stress_work(deformations, way, state, velocity_gradient)
    }

    fn yields(&self, deformations: [&Matrix<D>; 2], state: &M::State) -> bool {
        self.0.yields(deformations, state)
    }

    #[inline(always)]
    fn volume_ratio(&self, deformation_gradient: &Matrix<D>, state: &M::State) -> f64 {
        self.0.volume_ratio(deformation_gradient, state)
    }

    fn wave_speed(&self, particles: &Particles<D, M::State>) -> Result<f64, MpmError> {
        self.0.wave_speed(particles)
    }
}
