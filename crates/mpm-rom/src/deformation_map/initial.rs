//! Bodies that do not start at rest.

use mpm_tensor::{Matrix, vector};

use super::MaterialPoints;
use crate::manifold::{Evaluation, Manifold, Wanted};

/// V₀(X) = c + L X, X relative to the centroid at rest: uniform and affine fields (ours; the paper's bodies start at rest).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineVelocity<const D: usize> {
    /// c, the velocity of the centroid.
    pub constant: [f64; D],
    /// L = ∇V₀.
    pub gradient: Matrix<D>,
}

impl<const D: usize> AffineVelocity<D> {
    /// V₀(X).
    pub fn at(&self, reference: &[f64; D]) -> [f64; D] {
        vector::add(&self.constant, &self.gradient.apply(reference))
    }
}

/// V₀, and the rates v̂₀ that come nearest to it.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialMotion<const D: usize> {
    /// V₀.
    pub velocity: AffineVelocity<D>,
    /// v̂₀.
    pub rates: Vec<f64>,
}

/// Relative size of the difference quotient's step.
const STEP: f64 = 1e-5;

impl<const D: usize> InitialMotion<D> {
    /// b(X) and ∇b(X) = L − d/dε ∇g̃(X, x̂₀ + ε v̂₀) at ε = 0, the mixed derivative as a central difference of ∇g̃ along v̂₀, whose step changes
    /// coordinates by 10⁻⁵ (1 + |x̂₀|).
    pub(super) fn drifts<M: Manifold<D>>(
        &self,
        manifold: &M,
        rest: &[f64],
        at_rest: &Evaluation<D>,
        out: &mut MaterialPoints<D>,
    ) {
        let r = self.rates.len().max(1);
        for (x, columns) in out.reference.iter().zip(at_rest.jacobians.chunks_exact(r)) {
            let mut drift = self.velocity.at(x);
            for (column, rate) in columns.iter().zip(&self.rates) {
                vector::accumulate(&mut drift, -rate, column);
            }
            out.drifts.push(drift);
        }
        let size = |list: &[f64]| list.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        let speed = size(&self.rates);
        out.drift_gradients.resize(out.reference.len(), self.velocity.gradient);
        if speed == 0.0 {
            return;
        }
        let step = STEP * (1.0 + size(rest)) / speed;
        let wanted = Wanted {
            gradients: true,
            ..Wanted::default()
        };
        let mut moved = Evaluation::default();
        for sign in [1.0, -1.0] {
            let latent: Vec<f64> = rest.iter().zip(&self.rates).map(|(y, w)| y + sign * step * w).collect();
            manifold.evaluate(&out.reference, &latent, wanted, &mut moved);
            for (gradient, there) in out.drift_gradients.iter_mut().zip(&moved.gradients) {
                *gradient -= *there * (0.5 * sign / step);
            }
        }
    }
}
