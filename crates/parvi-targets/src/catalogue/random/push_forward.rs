//! A law carried along by invertible maps.

use mpm_tensor::vector;

use crate::{BoxedBijection, BoxedLaw, Target, UnitCubeTransport};

/// The law of x = T_n(…T_1(y)…) for y of a base law p: with y_0 = y, y_k = T_k(y_{k−1}),
/// log q(x) = log p(y_0) − Σ_k log|det J_k(y_{k−1})|, and the score by the chain rule, g ← J_k⁻ᵀ (g − ∇ log|det J_k|) from
/// g = ∇ log p(y_0) on. Exact to rounding, without finite differences.
#[derive(Debug)]
pub struct PushForward<const D: usize> {
    base: BoxedLaw<D>,
    maps: Vec<BoxedBijection<D>>,
}

impl<const D: usize> PushForward<D> {
    /// The law of `base` after the maps T_1, …, T_n, the first of which acts first.
    pub fn new(base: BoxedLaw<D>, maps: Vec<BoxedBijection<D>>) -> Self {
        Self { base, maps }
    }
}

impl<const D: usize> Target<D> for PushForward<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let (mut y, mut volumes) = (*x, 0.0);
        for map in self.maps.iter().rev() {
            y = map.inverse(&y);
            volumes += map.log_determinant(&y);
        }
        self.base.log_density(&y) - volumes
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut y = *x;
        let mut before = Vec::with_capacity(self.maps.len());
        for map in self.maps.iter().rev() {
            y = map.inverse(&y);
            before.push(y);
        }
        let mut gradient = self.base.score(&y);
        for (map, y) in self.maps.iter().zip(before.iter().rev()) {
            let slope = map.log_determinant_gradient(y);
            gradient = map.push_gradient(y, &vector::subtract(&gradient, &slope));
        }
        gradient
    }
}

impl<const D: usize> UnitCubeTransport<D> for PushForward<D> {
    fn cube_dimension(&self) -> usize {
        self.base.cube_dimension()
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let base = self.base.transport(u);
        self.maps.iter().fold(base, |y, map| map.forward(&y))
    }
}
