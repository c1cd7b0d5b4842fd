//! One iteration of support points.

use mpm_tensor::vector;

use crate::cloud::Cloud;

/// Particles that one task moves.
const TOGETHER: usize = 16;

/// A measure that particles are drawn to.
pub(crate) struct SupportPoints<const D: usize> {
    measure: Cloud<D>,
}

impl<const D: usize> SupportPoints<D> {
    /// Of points and weights, which need not sum to one. Distances to the measure below 1/n hardly count as smaller.
    pub fn new(points: &[[f64; D]], weights: &[f64]) -> Self {
        let total: f64 = weights.iter().sum();
        let softening = (points.len().max(1) as f32).powi(-2).max(1e-12);
        Self {
            measure: Cloud::new(points, |index| weights[index] / total, softening),
        }
    }

    /// Where the procedure of Mak and Joseph moves every particle, and 2 E|x − Y| − E|x − x′| before it.
    pub fn moved(&self, particles: &[[f64; D]]) -> (Vec<[f64; D]>, f64) {
        let share = (particles.len().max(1) as f64).recip();
        let others = Cloud::new(particles, |_| share, f32::MIN_POSITIVE);
        let of = |x: &[f64; D]| {
            let (pull, push) = (self.measure.pull(x), others.pull(x));
            let step = vector::subtract(&pull.direction, &push.direction);
            let moved = vector::add_scaled(x, 1.0 / pull.inverse.max(f64::MIN_POSITIVE), &step);
            (moved, 2.0 * pull.distance - push.distance)
        };
        let each = mpm_parallel::collect(particles.len(), TOGETHER, &|index| of(&particles[index]));
        let energy = each.iter().map(|(_, energy)| energy).sum::<f64>() * share;
        (each.into_iter().map(|(moved, _)| moved).collect(), energy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_move_is_the_formula() {
        let points: Vec<[f64; 3]> = (0..11)
            .map(|m| [1.0, 2.0, 3.0].map(|rate: f64| (rate * f64::from(m) + 0.3).sin()))
            .collect();
        let weights: Vec<f64> = (0..11).map(|m| if m == 4 { -1.0 } else { f64::from(m + 1) }).collect();
        let total: f64 = weights.iter().sum();
        let start = [[0.1, 0.2, 0.3], [-0.5, 0.4, 0.0], [0.9, -0.9, 0.2]];
        let (moved, _) = SupportPoints::new(&points, &weights).moved(&start);
        for (x, y) in start.iter().zip(&moved) {
            let (mut positive, mut sum) = (0.0, [0.0; 3]);
            for (s, c) in points.iter().zip(&weights) {
                let inverse = c / total / (vector::distance_squared(x, s) + 1.0 / 121.0).sqrt();
                let to = if inverse > 0.0 { *s } else { vector::subtract(s, x) };
                positive += inverse.max(0.0);
                vector::accumulate(&mut sum, inverse, &to);
            }
            for other in start.iter().filter(|other| *other != x) {
                let apart = vector::subtract(x, other);
                vector::accumulate(&mut sum, 1.0 / 3.0 / vector::norm(&apart), &apart);
            }
            assert!(vector::distance(y, &vector::scale(&sum, 1.0 / positive)) < 1e-5);
        }
    }
}
