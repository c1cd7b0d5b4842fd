//! One iteration of support points, in single precision, sixteen points of the measure at a time.

use mpm_tensor::vector;

/// Points per group.
const LANES: usize = 16;

/// Particles that one task moves.
const TOGETHER: usize = 16;

type Lanes = [f32; LANES];

/// A measure that particles are drawn to.
///
/// Single precision: a sum over n points is right to 1e-6 √n of its size, and what a particle feels of another one is 1/M of it.
pub(crate) struct SupportPoints<const D: usize> {
    groups: Vec<[Lanes; D]>,
    weights: Vec<Lanes>,
    /// Square of a length below which distances to the measure hardly count as smaller.
    softening: f32,
}

impl<const D: usize> SupportPoints<D> {
    /// Of points and weights, which need not sum to one.
    pub fn new(points: &[[f64; D]], weights: &[f64]) -> Self {
        let total: f64 = weights.iter().sum();
        let lane = |values: &[f64], lane: usize| values.get(lane).map_or(0.0, |c| (c / total) as f32);
        let weights = weights.chunks(LANES);
        let count = points.len();
        let at = |points: &[[f64; D]], lane: usize, axis: usize| points[lane.min(points.len() - 1)][axis] as f32;
        let groups = points.chunks(LANES);
        Self {
            groups: groups
                .map(|points| std::array::from_fn(|axis| std::array::from_fn(|lane| at(points, lane, axis))))
                .collect(),
            weights: weights.map(|values| std::array::from_fn(|l| lane(values, l))).collect(),
            softening: (count.max(1) as f32).powi(-2).max(1e-12),
        }
    }

    /// Where the procedure of Mak and Joseph moves every particle, and 2 E|x − Y| − E|x − x′| before it.
    pub fn moved(&self, particles: &[[f64; D]]) -> (Vec<[f64; D]>, f64) {
        let of = |x: &[f64; D]| {
            let (sum, pull, distance) = pulp::Arch::new().dispatch(|| self.pull(x));
            let (push, others) = repulsion(x, particles);
            let pull = std::array::from_fn(|axis| f64::from(pull[axis]) + push[axis]);
            let moved = vector::add_scaled(x, 1.0 / f64::from(sum).max(f64::MIN_POSITIVE), &pull);
            (moved, 2.0 * f64::from(distance) - others)
        };
        let each = mpm_parallel::collect(particles.len(), TOGETHER, &|index| of(&particles[index]));
        let energy = each.iter().map(|(_, energy)| energy).sum::<f64>() / particles.len().max(1) as f64;
        (each.into_iter().map(|(moved, _)| moved).collect(), energy)
    }

    /// Σ₊ c/|y − x|, Σ c (y − x)/|y − x| and Σ c |y − x|.
    #[inline(always)]
    fn pull(&self, x: &[f64; D]) -> (f32, [f32; D], f32) {
        let x = x.map(|coordinate| coordinate as f32);
        let (mut sums, mut pulls, mut distances) = ([0.0; LANES], [[0.0; LANES]; D], [0.0; LANES]);
        for (group, weights) in self.groups.iter().zip(&self.weights) {
            let (mut squares, mut apart) = ([self.softening; LANES], [[0.0; LANES]; D]);
            for axis in 0..D {
                for lane in 0..LANES {
                    apart[axis][lane] = group[axis][lane] - x[axis];
                    squares[lane] += apart[axis][lane] * apart[axis][lane];
                }
            }
            let mut inverse = [0.0; LANES];
            for lane in 0..LANES {
                inverse[lane] = weights[lane] * inverse_root(squares[lane]);
                sums[lane] += inverse[lane].max(0.0);
                distances[lane] += inverse[lane] * squares[lane];
            }
            for axis in 0..D {
                for lane in 0..LANES {
                    pulls[axis][lane] += inverse[lane] * apart[axis][lane];
                }
            }
        }
        (
            sums.iter().sum(),
            pulls.map(|lanes| lanes.iter().sum()),
            distances.iter().sum(),
        )
    }
}

/// 1/√x of a normal positive number to 5e-6 of it: a guess from the bits, and two of Newton's steps.
///
/// C. Lomont, *Fast inverse square root*, 2003. A root and a division take three times as long.
#[inline(always)]
fn inverse_root(x: f32) -> f32 {
    let guess = f32::from_bits(0x5f37_5a86 - (x.to_bits() >> 1));
    let newton = |y: f32| y * (1.5 - 0.5 * x * y * y);
    newton(newton(guess))
}

/// 1/M Σ_j (x − x_j)/|x − x_j| and 1/M Σ_j |x − x_j|.
fn repulsion<const D: usize>(x: &[f64; D], particles: &[[f64; D]]) -> ([f64; D], f64) {
    let (mut push, mut sum) = ([0.0; D], 0.0);
    for other in particles {
        let apart = vector::subtract(x, other);
        let distance = vector::norm(&apart);
        sum += distance;
        if distance > 0.0 {
            vector::accumulate(&mut push, 1.0 / (distance * particles.len() as f64), &apart);
        }
    }
    (push, sum / particles.len() as f64)
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
