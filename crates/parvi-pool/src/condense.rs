//! M particles of equal mass from weighted points: support points.

use mpm_tensor::{Matrix, vector};

use crate::lanes::{Group, LANES, Lanes, packed};
use crate::mixture::{Kernel, Mixture};
use crate::weights::systematic;

/// Iterations at most, and the largest move, in units of the spread, at which they end.
const ITERATIONS: usize = 40;
const TOLERANCE: f64 = 1e-3;

/// Particles that one task moves.
const TOGETHER: usize = 16;

/// How far beside its point a particle begins, in units of the particles' distance.
const BESIDE: f64 = 0.2;

/// Share of the weight that the lightest points may take with them.
const LEFT_OUT: f64 = 1e-4;

/// M points of least energy distance from weighted ones, every axis in units of its standard deviation.
///
/// The convex–concave procedure of S. Mak, V. R. Joseph, *Support points*, Ann. Stat. 46, 2018, Eq. (22), with weights W that sum to one:
/// x ← (Σ_m W_m/|x − y_m|)⁻¹ (Σ_m W_m y_m/|x − y_m| + 1/M Σ_j (x − x_j)/|x − x_j|). It starts from a resample in the order of a tree of bisected boxes, so
/// that every part of space gets its share of the particles. Empty where nothing has weight.
pub fn condense<const D: usize>(points: &[[f64; D]], weights: &[f64], count: usize, offset: f64) -> Vec<[f64; D]> {
    let (points, weights) = heaviest(points, weights);
    if points.is_empty() {
        return Vec::new();
    }
    let (mean, covariance) = crate::sample::moments(&points, &weights);
    let scales: [f64; D] = std::array::from_fn(|a| {
        Some(covariance.0[a][a].sqrt())
            .filter(|s| *s > 0.0 && s.is_finite())
            .unwrap_or(1.0)
    });
    let mut scaled: Vec<([f64; D], f64)> = points
        .iter()
        .zip(&weights)
        .map(|(x, w)| (std::array::from_fn(|a| (x[a] - mean[a]) / scales[a]), *w))
        .collect();
    bisect(&mut scaled);
    let sample: Vec<[f64; D]> = scaled.iter().map(|(x, _)| *x).collect();
    let weights: Vec<f64> = scaled.iter().map(|(_, w)| *w).collect();
    // A particle on a point of the sample would stay there, and equal particles do not push each other: every one begins beside its point.
    let beside = Mixture::new(vec![Kernel {
        centre: [0.0; D],
        factor: Matrix::IDENTITY * (BESIDE * (count.max(1) as f64).powf(-1.0 / D as f64)),
        share: 1.0,
    }]);
    let shifts = beside.map_or_else(Vec::new, |law| law.draws(count, 0));
    let chosen = systematic(&weights, count, offset);
    let mut moving: Vec<[f64; D]> = chosen
        .iter()
        .zip(&shifts)
        .map(|(&index, shift)| vector::add(&sample[index], shift))
        .collect();
    let procedure = Procedure::new(&sample, &weights);
    for _ in 0..ITERATIONS {
        if procedure.iterate(&mut moving) < TOLERANCE {
            break;
        }
    }
    moving
        .iter()
        .map(|x| std::array::from_fn(|a| mean[a] + scales[a] * x[a]))
        .collect()
}

/// All points but the lightest.
fn heaviest<const D: usize>(points: &[[f64; D]], weights: &[f64]) -> (Vec<[f64; D]>, Vec<f64>) {
    let mut order: Vec<usize> = (0..points.len().min(weights.len()))
        .filter(|&i| weights[i] > 0.0 && weights[i].is_finite() && vector::is_finite(&points[i]))
        .collect();
    order.sort_by(|&a, &b| weights[a].total_cmp(&weights[b]).then(a.cmp(&b)));
    let total: f64 = order.iter().map(|&i| weights[i]).sum();
    let mut sum = 0.0;
    let light = order
        .iter()
        .take_while(|&&i| {
            sum += weights[i];
            sum < LEFT_OUT * total
        })
        .count();
    let mut kept = order.split_off(light);
    kept.sort_unstable();
    (
        kept.iter().map(|&i| points[i]).collect(),
        kept.iter().map(|&i| weights[i]).collect(),
    )
}

/// Orders points so that near ones stand near: halves along the longest axis, and so on.
fn bisect<const D: usize>(points: &mut [([f64; D], f64)]) {
    if points.len() < 3 || D == 0 {
        return;
    }
    let extent = |axis: usize| {
        let (low, high) = points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| {
                (low.min(x[axis]), high.max(x[axis]))
            });
        high - low
    };
    let axis = (0..D).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    let (low, high) = points.split_at_mut(middle);
    bisect(low);
    bisect(high);
}

struct Procedure<const D: usize> {
    groups: Vec<Group<D>>,
    weights: Vec<Lanes>,
    /// Square of a length below which distances to the sample hardly count as smaller.
    softening: f64,
}

impl<const D: usize> Procedure<D> {
    fn new(sample: &[[f64; D]], weights: &[f64]) -> Self {
        let total: f64 = weights.iter().sum();
        let lanes = |chunk: &[f64]| std::array::from_fn(|lane| chunk.get(lane).map_or(0.0, |w| w / total));
        Self {
            softening: (sample.len().max(1) as f64).powf(-2.0).max(1e-16),
            groups: packed(sample),
            weights: weights.chunks(LANES).map(lanes).collect(),
        }
    }

    /// Moves all points once; returns the largest move.
    fn iterate(&self, points: &mut Vec<[f64; D]>) -> f64 {
        let moved: Vec<[f64; D]> =
            mpm_parallel::collect(points.len(), TOGETHER, &|index| self.moved(&points[index], points));
        let moves = points.iter().zip(&moved).map(|(x, y)| vector::distance(x, y));
        let largest = moves.fold(0.0, f64::max);
        *points = moved;
        largest
    }

    fn moved(&self, x: &[f64; D], points: &[[f64; D]]) -> [f64; D] {
        let (mut sums, mut pulls) = ([0.0; LANES], [[0.0; LANES]; D]);
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
                inverse[lane] = weights[lane] / squares[lane].sqrt();
                sums[lane] += inverse[lane];
            }
            for axis in 0..D {
                for lane in 0..LANES {
                    pulls[axis][lane] += inverse[lane] * apart[axis][lane];
                }
            }
        }
        let weight: f64 = sums.iter().sum();
        let mut pull: [f64; D] = pulls.map(|lanes| lanes.iter().sum());
        for other in points {
            let apart = vector::subtract(x, other);
            let distance = vector::norm(&apart);
            if distance > 0.0 {
                vector::accumulate(&mut pull, 1.0 / (distance * points.len() as f64), &apart);
            }
        }
        vector::add_scaled(x, 1.0 / weight.max(f64::MIN_POSITIVE), &pull)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_move_is_the_formula() {
        let sample: Vec<[f64; 3]> = (0..11)
            .map(|m| [1.0, 2.0, 3.0].map(|rate: f64| (rate * f64::from(m) + 0.3).sin()))
            .collect();
        let weights: Vec<f64> = (1..12).map(f64::from).collect();
        let start = vec![[0.1, 0.2, 0.3], [-0.5, 0.4, 0.0], [0.9, -0.9, 0.2]];
        let mut moved = start.clone();
        Procedure::new(&sample, &weights).iterate(&mut moved);
        for (x, y) in start.iter().zip(&moved) {
            let (mut weight, mut sum) = (0.0, [0.0; 3]);
            for (s, w) in sample.iter().zip(&weights) {
                let inverse = w / 66.0 / (vector::distance_squared(x, s) + 1.0 / 121.0).sqrt();
                weight += inverse;
                vector::accumulate(&mut sum, inverse, s);
            }
            for other in start.iter().filter(|other| *other != x) {
                let apart = vector::subtract(x, other);
                vector::accumulate(&mut sum, 1.0 / 3.0 / vector::norm(&apart), &apart);
            }
            assert!(vector::distance(y, &vector::scale(&sum, 1.0 / weight)) < 1e-12);
        }
    }

    #[test]
    fn pieces_keep_their_masses() {
        let points: Vec<[f64; 1]> = (0..100)
            .map(|i| [f64::from(i % 2) * 10.0 + f64::from(i) * 0.001])
            .collect();
        let weights: Vec<f64> = (0..100).map(|i| if i % 2 == 0 { 0.25 } else { 0.75 }).collect();
        let particles = condense(&points, &weights, 40, 0.5);
        assert_eq!(particles.iter().filter(|x| x[0] > 5.0).count(), 30);
        assert!(condense(&points, &[0.0; 100], 40, 0.5).is_empty());
    }
}
