//! From the velocities of the sample points to v̂ and x̂.

use super::Update;
use crate::deformation_map::{DeformationMap, MaterialPoints};
use crate::least_squares::{GaussNewton, LeastSquares, LeastSquaresError, Settings};
use crate::manifold::Evaluation;

/// When the search for x̂ ends.
const SETTINGS: Settings = Settings {
    iterations: 3,
    tolerance: 1e-10,
    halvings: 8,
};

/// The coordinates of a run and what moves them.
#[derive(Default)]
pub(super) struct Coordinates<const D: usize> {
    /// x̂_n.
    pub latent: Vec<f64>,
    /// v̂_n.
    pub rates: Vec<f64>,
    /// x̂_{n−1}; empty before the first step.
    before: Vec<f64>,
    start: Vec<f64>,
    solver: LeastSquares,
    search: GaussNewton<D>,
}

impl<const D: usize> Coordinates<D> {
    /// `weights` are those of the sample points; none where all are the same.
    pub fn new(latent: Vec<f64>, weights: Vec<f64>) -> Self {
        Self {
            rates: vec![0.0; latent.len()],
            latent,
            solver: LeastSquares::weighted(&weights),
            search: GaussNewton::weighted(weights),
            ..Self::default()
        }
    }

    /// Other sample points have other weights.
    pub fn weigh(&mut self, weights: Vec<f64>) {
        self.solver.weigh(&weights);
        self.search.weigh(weights);
    }

    /// v̂ = argmin Σ ω_p |∂g/∂x̂(X_p, x̂_n) v̂ − v_p|²; `evaluation` is that of the sample points at x̂_n.
    pub fn find_rates(&mut self, evaluation: &Evaluation<D>, velocities: &[[f64; D]]) -> Result<(), LeastSquaresError> {
        self.solver.solve(&evaluation.jacobians, velocities, &mut self.rates)
    }

    /// x̂_{n+1}; `positions` are where the sample points have moved.
    pub fn advance(
        &mut self,
        map: &DeformationMap<'_, D>,
        samples: &MaterialPoints<D>,
        positions: &[[f64; D]],
        time_step: f64,
        update: Update,
    ) -> Result<(), LeastSquaresError> {
        let moved = self.latent.iter().zip(&self.rates).map(|(y, w)| y + time_step * w);
        self.start.clear();
        match update {
            Update::VelocityOnly => self.start.extend(moved),
            Update::PositionVelocity => {
                if self.before.is_empty() {
                    // There is no x̂_{−1}: the rates stand for the difference.
                    self.start.extend(moved);
                } else {
                    let pairs = self.latent.iter().zip(&self.before);
                    self.start.extend(pairs.map(|(y, before)| 2.0 * y - before));
                }
                self.search
                    .minimise(positions, &mut self.start, &SETTINGS, |y, wanted, out| {
                        map.evaluate(samples, y, wanted, out);
                    })?;
            }
        }
        if !self.start.iter().all(|y| y.is_finite()) {
            return Err(LeastSquaresError::NotFinite);
        }
        std::mem::swap(&mut self.before, &mut self.latent);
        std::mem::swap(&mut self.latent, &mut self.start);
        Ok(())
    }
}
