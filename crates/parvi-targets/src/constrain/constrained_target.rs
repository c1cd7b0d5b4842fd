//! A density of constrained coordinates as a target in unconstrained ones.

use crate::{Constraints, Target};

/// The target log q(y) = log p(f(y)) + log |det J| of a density p of N constrained coordinates x = f(y); from
/// [`Constraints::target`].
///
/// Scores stay finite wherever those of p times ∂x/∂y do, and for |y| ≤ 700 where p diverges no faster than c / distance at the boundary of
/// its support. Near a boundary that is not zero, distances to it have the rounding of x: within 10⁻¹³ of a bound of 1 (y ≈ 30)
/// a score of p itself has three digits.
#[derive(Clone, Debug)]
pub struct ConstrainedTarget<T, const N: usize, const D: usize> {
    density: T,
    constraints: Constraints<N, D>,
}

impl<T, const N: usize, const D: usize> ConstrainedTarget<T, N, D> {
    pub(crate) fn new(density: T, constraints: Constraints<N, D>) -> Self {
        Self { density, constraints }
    }

    /// The density of constrained coordinates.
    pub fn density(&self) -> &T {
        &self.density
    }

    /// The constraints.
    pub fn constraints(&self) -> &Constraints<N, D> {
        &self.constraints
    }
}

impl<T: Target<N>, const N: usize, const D: usize> Target<D> for ConstrainedTarget<T, N, D> {
    fn log_density(&self, y: &[f64; D]) -> f64 {
        let x = self.constraints.constrain(y);
        self.density.log_density(&x) + self.constraints.log_jacobian_at(y, &x)
    }

    fn score(&self, y: &[f64; D]) -> [f64; D] {
        let x = self.constraints.constrain(y);
        self.constraints.pull_back_score_at(y, &x, &self.density.score(&x))
    }

    fn has_log_density(&self) -> bool {
        self.density.has_log_density()
    }

    fn points_per_call(&self) -> usize {
        self.density.points_per_call()
    }

    fn scores_depend_on_calls(&self) -> bool {
        self.density.scores_depend_on_calls()
    }

    /// One batch of the density's.
    fn scores(&self, ys: &[[f64; D]], out: &mut [[f64; D]]) {
        let xs = self.constraints.constrain_all(ys);
        let mut scores = vec![[0.0; N]; xs.len()];
        self.density.scores(&xs, &mut scores);
        for (((y, x), score), out) in ys.iter().zip(&xs).zip(&scores).zip(out) {
            *out = self.constraints.pull_back_score_at(y, x, score);
        }
    }

    /// One batch of the density's.
    fn log_densities(&self, ys: &[[f64; D]], out: &mut [f64]) {
        let xs = self.constraints.constrain_all(ys);
        self.density.log_densities(&xs, out);
        for ((y, x), out) in ys.iter().zip(&xs).zip(out) {
            *out += self.constraints.log_jacobian_at(y, x);
        }
    }
}
