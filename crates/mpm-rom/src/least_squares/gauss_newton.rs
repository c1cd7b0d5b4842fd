//! min_y Σ_p ω_p |g_p(y) − x_p|².

use mpm_tensor::vector;

use super::{LeastSquares, LeastSquaresError};
use crate::manifold::{Evaluation, Wanted};

/// When a Gauss–Newton iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Steps, at most.
    pub iterations: usize,
    /// It ends when a step changes no coordinate by more than this multiple of 1 + its size.
    pub tolerance: f64,
    /// Halvings of a step that does not lower the sum, at most.
    pub halvings: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            iterations: 50,
            tolerance: 1e-12,
            halvings: 30,
        }
    }
}

/// Gauss–Newton with backtracking: the step w = argmin Σ ω_p |∂g_p/∂y w − (x_p − g_p(y))|², halved until the sum falls.
#[derive(Default)]
pub struct GaussNewton<const D: usize> {
    /// ω_p; none where all points weigh the same.
    weights: Vec<f64>,
    solver: LeastSquares,
    evaluation: Evaluation<D>,
    residuals: Vec<[f64; D]>,
    step: Vec<f64>,
    trial: Vec<f64>,
}

impl<const D: usize> GaussNewton<D> {
    /// With these weights of the points, as in [`LeastSquares::weighted`].
    pub fn weighted(weights: Vec<f64>) -> Self {
        Self {
            solver: LeastSquares::weighted(&weights),
            weights,
            ..Self::default()
        }
    }

    /// Other weights of the points; the storage stays.
    pub(crate) fn weigh(&mut self, weights: Vec<f64>) {
        self.solver.weigh(&weights);
        self.weights = weights;
    }

    /// Moves `y` to a minimum, and returns that, Σ_p ω_p |g_p(y) − x_p|²; `evaluate` gives g_p(y), with ∂g_p/∂y where wanted.
    ///
    /// # Errors
    /// [`LeastSquaresError`] where a step cannot be computed; `y` is then the best point so far.
    pub fn minimise(
        &mut self,
        targets: &[[f64; D]],
        y: &mut [f64],
        settings: &Settings,
        mut evaluate: impl FnMut(&[f64], Wanted, &mut Evaluation<D>),
    ) -> Result<f64, LeastSquaresError> {
        self.step.resize(y.len(), 0.0);
        self.trial.resize(y.len(), 0.0);
        evaluate(y, Wanted::JACOBIANS, &mut self.evaluation);
        let mut sum = self.sum(targets);
        if !sum.is_finite() {
            return Err(LeastSquaresError::NotFinite);
        }
        for iteration in 0..settings.iterations {
            if iteration > 0 {
                evaluate(y, Wanted::JACOBIANS, &mut self.evaluation);
            }
            let pairs = targets.iter().zip(&self.evaluation.positions);
            self.residuals.clear();
            self.residuals.extend(pairs.map(|(x, g)| vector::subtract(x, g)));
            self.solver
                .solve(&self.evaluation.jacobians, &self.residuals, &mut self.step)?;
            let moves = self.step.iter().zip(y.iter());
            let still = moves
                .clone()
                .all(|(w, y)| w.abs() <= settings.tolerance * (1.0 + y.abs()));
            let (mut share, mut lower) = (1.0, None);
            for _ in 0..=settings.halvings {
                for ((trial, y), w) in self.trial.iter_mut().zip(y.iter()).zip(&self.step) {
                    *trial = y + share * w;
                }
                evaluate(&self.trial, Wanted::default(), &mut self.evaluation);
                let candidate = self.sum(targets);
                if candidate < sum {
                    lower = Some(candidate);
                    break;
                }
                if still {
                    break;
                }
                share *= 0.5;
            }
            let Some(candidate) = lower else {
                // No step along the descent direction lowers the sum: rounding.
                return Ok(sum);
            };
            y.copy_from_slice(&self.trial);
            sum = candidate;
            if still {
                break;
            }
        }
        Ok(sum)
    }

    fn sum(&self, targets: &[[f64; D]]) -> f64 {
        let positions = &self.evaluation.positions;
        if self.weights.is_empty() {
            return squared_distance(targets, positions);
        }
        let pairs = targets.iter().zip(positions).zip(&self.weights);
        pairs
            .map(|((a, b), weight)| weight * vector::distance_squared(a, b))
            .sum()
    }
}

/// Σ_p |a_p − b_p|².
pub(crate) fn squared_distance<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| vector::distance_squared(a, b)).sum()
}
