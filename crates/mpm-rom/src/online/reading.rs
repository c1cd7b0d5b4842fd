//! What a step says of the velocities of all points, without being taken.

use mpm_dense::SymmetricEigen;

use super::scaled_reading::mean_product;
use super::{OnlineError, ReducedModel};
use crate::manifold::{Evaluation, Wanted};

/// Eigenvalues below this multiple of the largest one are rounding.
const LEAST_SQUARE: f64 = 1e-14;

/// Jacobians and velocities of the sample points in a step from some state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading<const D: usize> {
    /// ∂g/∂x̂_k at x̂_n, entry p r + k.
    pub jacobians: Vec<[f64; D]>,
    /// v_p at the end of the step: what v̂ is found from. Kinematic points have the velocity of their motion, with velocity-only, too.
    pub velocities: Vec<[f64; D]>,
}

impl<const D: usize> ReducedModel<'_, D> {
    /// What the step from `time` on would read at the sample points if x̂ and v̂ were these; the model's own coordinates and time stay. Where every step has its own sample points,
    /// they are those of the step that is read.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn reading(&mut self, latent: &[f64], rates: &[f64], time: f64) -> Result<Reading<D>, OnlineError> {
        let step = (time / self.body.time_step).round() as u64 + 1;
        let own_step = std::mem::replace(&mut self.step, step);
        let own_latent = std::mem::replace(&mut self.coordinates.latent, latent.to_vec());
        let own_rates = std::mem::replace(&mut self.coordinates.rates, rates.to_vec());
        let read = self.find_velocities();
        (self.step, self.coordinates.latent, self.coordinates.rates) = (own_step, own_latent, own_rates);
        read?;
        Ok(Reading {
            jacobians: self.evaluation.jacobians.clone(),
            velocities: self.velocities.clone(),
        })
    }

    /// g, F and ∂g/∂x̂ of the sample points at other coordinates.
    pub fn evaluate_at(&self, latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>) {
        self.map.evaluate(&self.samples, latent, wanted, out);
    }

    /// 2 r states around one: the eigenvectors of |𝒫|⁻¹ Σ_p J_pᵀ J_p with both signs, so long that to first order the positions of the sample points differ by `distance` (m) in the root mean
    /// square. Directions that move nothing are left out.
    pub fn states_around(&self, latent: &[f64], distance: f64) -> Vec<Vec<f64>> {
        let (mut there, r) = (Evaluation::default(), latent.len());
        self.evaluate_at(latent, Wanted::JACOBIANS, &mut there);
        let Some(eigen) = SymmetricEigen::new(&mean_product(r, &there.jacobians)) else {
            return Vec::new();
        };
        let least = LEAST_SQUARE * eigen.values.iter().copied().fold(0.0, f64::max);
        let moving = |value: &f64| if *value > least { *value } else { f64::NAN };
        let lengths = eigen.values.iter().map(|value| distance / moving(value).sqrt());
        let states = lengths.enumerate().flat_map(|(k, length)| {
            [length, -length].map(|length| (0..r).map(|i| latent[i] + length * eigen.vectors[(i, k)]).collect())
        });
        states
            .filter(|state: &Vec<f64>| state.iter().all(|y| y.is_finite()))
            .collect()
    }
}
