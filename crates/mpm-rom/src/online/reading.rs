//! What a step says of the velocities of all points, without being taken.

use faer::{Mat, Side};
use mpm_tensor::vector;

use super::{OnlineError, ReducedModel};
use crate::manifold::{Evaluation, Manifold, Wanted};

/// Jacobians and velocities of the sample points in a step from some state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading<const D: usize> {
    /// ∂g/∂x̂_k at x̂_n, entry p r + k.
    pub jacobians: Vec<[f64; D]>,
    /// v_p at the end of the step, without b f′: what v̂ is found from. Kinematic points have the velocity of their motion, with velocity-only, too.
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

    /// g, F and ∂g/∂x̂ of the sample points at other coordinates.
    pub fn evaluate_at(&self, latent: &[f64], time: f64, wanted: Wanted, out: &mut Evaluation<D>) {
        self.map.evaluate(&self.samples, latent, time, wanted, out);
    }

    /// 2 r states around one: the eigenvectors of |𝒫|⁻¹ Σ_p J_pᵀ J_p with both signs, so long that to first order the positions of the sample points differ by `distance` (m) in the root mean
    /// square. Directions that move nothing are left out.
    pub fn states_around(&self, latent: &[f64], time: f64, distance: f64) -> Vec<Vec<f64>> {
        let (mut there, r) = (Evaluation::default(), latent.len());
        let wanted = Wanted {
            jacobians: true,
            ..Wanted::default()
        };
        self.evaluate_at(latent, time, wanted, &mut there);
        let share = 1.0 / self.samples.len().max(1) as f64;
        let mut mean = Mat::<f64>::zeros(r, r);
        for rows in there.jacobians.chunks_exact(r.max(1)) {
            for i in 0..r {
                for j in 0..r {
                    mean[(i, j)] += share * vector::dot(&rows[i], &rows[j]);
                }
            }
        }
        let Ok(eigen) = mean.self_adjoint_eigen(Side::Lower) else {
            return Vec::new();
        };
        let lengths = (0..r).map(|k| distance / eigen.S().column_vector()[k].sqrt());
        let states = lengths.enumerate().flat_map(|(k, length)| {
            [length, -length].map(|length| (0..r).map(|i| latent[i] + length * eigen.U()[(i, k)]).collect())
        });
        states
            .filter(|state: &Vec<f64>| state.iter().all(|y| y.is_finite()))
            .collect()
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
