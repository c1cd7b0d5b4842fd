//! What a step says of the velocities of all points, without being taken.

use mpm_tensor::vector;

use super::{OnlineError, ReducedModel};
use crate::manifold::{Evaluation, Manifold, Wanted};

/// Jacobians and velocities of the sample points in a step from some state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading<const D: usize> {
    /// ∂g/∂x̂_k at x̂_n, entry p r + k.
    pub jacobians: Vec<[f64; D]>,
    /// v_p at the end of the step, without b f′: what v̂ is found from.
    pub velocities: Vec<[f64; D]>,
}

impl<const D: usize, M: Manifold<D>> ReducedModel<D, M> {
    /// What the step from `time` on would read at the sample points if x̂ and v̂ were these; the model's own coordinates and time stay.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn reading(&mut self, latent: &[f64], rates: &[f64], time: f64) -> Result<Reading<D>, OnlineError> {
        let step = (time / self.body.time_step).round() as u64 + 1;
        let own_step = std::mem::replace(&mut self.step, step);
        let own_latent = std::mem::replace(&mut self.coordinates.latent, latent.to_vec());
        let own_rates = std::mem::replace(&mut self.coordinates.rates, rates.to_vec());
        let read = self.velocities_of_step();
        (self.step, self.coordinates.latent, self.coordinates.rates) = (own_step, own_latent, own_rates);
        read?;
        let mut velocities = self.velocities.clone();
        for (velocity, drift) in velocities.iter_mut().zip(&self.samples.drifts) {
            *velocity = vector::subtract(velocity, drift);
        }
        Ok(Reading {
            jacobians: self.evaluation.jacobians.clone(),
            velocities,
        })
    }

    /// g, F and ∂g/∂x̂ of all material points at other coordinates.
    pub fn evaluate_at(&self, latent: &[f64], time: f64, wanted: Wanted, out: &mut Evaluation<D>) {
        self.map.evaluate(&self.points, latent, time, wanted, out);
    }

    /// (1) to (4) of a step.
    fn velocities_of_step(&mut self) -> Result<(), OnlineError> {
        self.place_samples();
        self.activate_nodes()?;
        self.place_quadrature()?;
        self.sum_at_nodes();
        self.move_samples()
    }
}
