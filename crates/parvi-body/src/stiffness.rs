//! How stiff the target is where the particles are: the curvature of −log p along their motion.

use mpm_tensor::vector;

/// Largest Δt √λ, λ the curvature of −log p where the particles are: the angle by which an oscillation advances in a step.
pub const OSCILLATION_ANGLE: f64 = 1.0;

/// Particles that are looked at, at most.
const SAMPLE: usize = 1 << 12;

/// λ = (Σ_p |s_p − s'_p|² / Σ_p |x_p − x'_p|²)^½ from one step to the next, x' and s' a step earlier: 1 for N(0, I).
///
/// In a well of curvature λ the body oscillates with the frequency √λ, and a Δt beyond 2/√λ would be unstable.
#[derive(Clone, Debug)]
pub struct Stiffness<const D: usize> {
    /// λ.
    pub estimate: f64,
    /// Every so many particles are looked at.
    pub stride: usize,
    /// Records of this step.
    pub now: Vec<Record<D>>,
    /// Records of the step before.
    pub before: Vec<Record<D>>,
}

/// Position and score of a particle.
pub type Record<const D: usize> = ([f64; D], [f64; D]);

impl<const D: usize> Default for Stiffness<D> {
    fn default() -> Self {
        Self {
            estimate: 1.0,
            stride: 1,
            now: Vec::new(),
            before: Vec::new(),
        }
    }
}

impl<const D: usize> Stiffness<D> {
    /// Positions and scores of this step, in the present order of the particles.
    pub fn record(&mut self, positions: &[[f64; D]], scores: &[[f64; D]]) {
        std::mem::swap(&mut self.now, &mut self.before);
        self.stride = positions.len().div_ceil(SAMPLE).max(1);
        let pairs = positions.iter().copied().zip(scores.iter().copied());
        self.now.clear();
        self.now.extend(pairs.step_by(self.stride));
    }

    /// Take the last two records into account: `order[k]` is where the k-th particle was one record ago. Half of the
    /// estimate is memory.
    pub fn update(&mut self, order: &[u32]) {
        if self.before.len() != self.now.len() {
            return;
        }
        let (mut scores, mut positions) = (0.0, 0.0);
        for (&(x, s), &from) in self.now.iter().zip(order.iter().step_by(self.stride)) {
            if (from as usize).is_multiple_of(self.stride) {
                let (x_before, s_before) = &self.before[from as usize / self.stride];
                scores += vector::distance_squared(&s, s_before);
                positions += vector::distance_squared(&x, x_before);
            }
        }
        let curvature = (scores / positions).sqrt();
        if curvature.is_finite() {
            self.estimate = 0.5 * (self.estimate + curvature);
        }
    }

    /// The largest Δt that follows the motion in such a well: [`OSCILLATION_ANGLE`] / √λ.
    pub fn time_limit(&self) -> f64 {
        OSCILLATION_ANGLE / self.estimate.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadratic_well_has_its_curvature_in_any_order() {
        for (count, curvature) in [(10, 4.0), (10, 0.25), (10_000, 9.0)] {
            let mut stiffness = Stiffness::<2>::default();
            let mut positions: Vec<[f64; 2]> = (0..count).map(|k| [f64::from(k), 1.0 / f64::from(k + 1)]).collect();
            for step in 0..40 {
                let order: Vec<u32> = if step % 2 == 0 {
                    (0..count as u32).collect()
                } else {
                    (0..count as u32).rev().collect()
                };
                positions = order
                    .iter()
                    .map(|&k| positions[k as usize].map(|c| 0.9 * c + 0.1))
                    .collect();
                let scores: Vec<[f64; 2]> = positions.iter().map(|x| x.map(|c| -curvature * c)).collect();
                stiffness.record(&positions, &scores);
                stiffness.update(&order);
            }
            let expected = OSCILLATION_ANGLE / f64::sqrt(curvature);
            assert!((stiffness.time_limit() - expected).abs() < 1e-6, "{count}, {curvature}");
        }
    }
}
