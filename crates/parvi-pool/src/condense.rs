//! M particles of equal mass from a measure: support points.

use mpm_tensor::{Matrix, vector};
use parvi_targets::Frame;

use crate::anderson::Anderson;
use crate::measure::Measure;
use crate::mixture::Mixture;
use crate::order::near_together;
use crate::pieces::{Weighted, in_pieces, oblique_directions};
use crate::student::Kernel;
use crate::support_points::SupportPoints;
use crate::weights::systematic;

/// A pass over space, which is cut into pieces so that the cost is that of many small measures.
struct Pass {
    /// Particles of one piece at most.
    most: usize,
    /// Iterations with few equally weighted points, or with all, where there are not many more.
    coarse: usize,
    /// Iterations with all points.
    fine: usize,
}

/// Particles stand in layers along the cuts of a pass. Each mends what the one before has left there, since it cuts along other planes.
const PASSES: [Pass; 3] = [Pass::new(64, 12, 0), Pass::new(128, 12, 0), Pass::new(256, 0, 9)];

/// Those few points, per particle.
const COARSE: usize = 8;

/// What rounding may add to an energy.
const ROUNDING: f64 = 1e-5;

/// The largest move, in units of the spread, at which they end.
const TOLERANCE: f64 = 1e-3;

/// How far beside its point a particle begins, in units of the particles' distance.
const BESIDE: f64 = 0.2;

/// Share of all |c| that the lightest points may take with them.
const LEFT_OUT: f64 = 1e-4;

/// [`condense`](crate::condense), generated where it is called.
pub(crate) fn condense<const D: usize>(measure: &Measure<D>, count: usize, offset: f64) -> Vec<[f64; D]> {
    let (mut scaled, frame) = standardised(measure);
    if scaled.is_empty() {
        return Vec::new();
    }
    near_together(&mut scaled, &[1.0; D]);
    let weights: Vec<f64> = scaled.iter().map(|(_, c)| *c).collect();
    let rises = rises(&weights);
    // A particle on a point of the sample would stay there, and equal particles do not push each other: every one begins beside its point.
    let beside = Mixture::new(vec![Kernel {
        centre: [0.0; D],
        factor: Matrix::IDENTITY * (BESIDE * (count.max(1) as f64).powf(-1.0 / D as f64)),
        share: 1.0,
    }]);
    let shifts = beside.map_or_else(Vec::new, |law| law.draws(count, 0));
    let begin = |(&index, shift): (&usize, &[f64; D])| vector::add(&scaled[index].0, shift);
    let chosen = systematic(&rises, count, offset);
    let mut moving: Vec<[f64; D]> = chosen.iter().zip(&shifts).map(begin).collect();
    let weighted = |(&(x, c), &rise)| Weighted { x, c, rise };
    let mut points: Vec<Weighted<D>> = scaled.iter().zip(&rises).map(weighted).collect();
    for (number, pass) in (0..).zip(PASSES) {
        let iterate = |points: &[Weighted<D>], particles: &mut [[f64; D]]| pass.iterate(points, particles, offset);
        in_pieces(
            &mut points,
            &mut moving,
            &oblique_directions(number),
            pass.most,
            &iterate,
        );
    }
    let flat = flat_coordinates(measure);
    let place = |z: &[f64; D]| {
        let x = frame.to_target(z);
        std::array::from_fn(|axis| flat[axis].unwrap_or(x[axis]))
    };
    moving.iter().map(place).collect()
}

/// The coordinates that all points with a weight have alike. Distances along them have no unit in which those below 1/n could be small.
fn flat_coordinates<const D: usize>(measure: &Measure<D>) -> [Option<f64>; D] {
    let first = sound(measure).next();
    std::array::from_fn(|axis| {
        let common = first?.0[axis];
        sound(measure).all(|(y, _)| y[axis] == common).then_some(common)
    })
}

/// The points with a weight.
fn sound<const D: usize>(measure: &Measure<D>) -> impl Iterator<Item = (&[f64; D], &f64)> {
    let all = measure.points.iter().zip(&measure.weights);
    all.filter(|(y, c)| **c != 0.0 && c.is_finite() && vector::is_finite(y))
}

impl Pass {
    const fn new(most: usize, coarse: usize, fine: usize) -> Self {
        Self { most, coarse, fine }
    }

    /// The iterations in one piece.
    fn iterate<const D: usize>(&self, points: &[Weighted<D>], particles: &mut [[f64; D]], offset: f64) {
        let places: Vec<[f64; D]> = points.iter().map(|point| point.x).collect();
        let (weights, rises): (Vec<f64>, Vec<f64>) = points.iter().map(|point| (point.c, point.rise)).unzip();
        // Noise may take the mass of a small piece below nothing.
        let sound = 2.0 * weights.iter().sum::<f64>() > rises.iter().sum();
        let weights = if sound { weights } else { rises.clone() };
        let mut iterations = self.coarse + self.fine;
        let count = COARSE * particles.len();
        if self.coarse > 0 && 2 * count < points.len() {
            let few: Vec<[f64; D]> = systematic(&rises, count, offset)
                .iter()
                .map(|&index| places[index])
                .collect();
            iterate(&SupportPoints::new(&few, &vec![1.0; few.len()]), self.coarse, particles);
            iterations = self.fine;
        }
        iterate(&SupportPoints::new(&places, &weights), iterations, particles);
    }
}

/// What every weight adds to the largest sum so far: none negative, and along the order as much in every stretch as the weights have, but for a few of them.
fn rises(weights: &[f64]) -> Vec<f64> {
    let (mut sum, mut largest) = (0.0_f64, 0.0_f64);
    let rise = |c: &f64| {
        sum += c;
        let rise = (sum - largest).max(0.0);
        largest = largest.max(sum);
        rise
    };
    weights.iter().map(rise).collect()
}

/// So many iterations, or until nothing moves any more.
fn iterate<const D: usize>(support: &SupportPoints<D>, iterations: usize, moving: &mut [[f64; D]]) {
    let mut anderson = Anderson::default();
    let mut least = f64::INFINITY;
    // What the procedure itself, which never fails to lower the energy, would have made.
    let mut plain: Option<Vec<[f64; D]>> = None;
    for _ in 0..iterations {
        let (images, energy) = support.moved(moving);
        if energy > least + ROUNDING * least.abs()
            && let Some(plain) = plain.take()
        {
            moving.copy_from_slice(&plain);
            anderson = Anderson::default();
            continue;
        }
        least = energy;
        let moves = moving.iter().zip(&images).map(|(x, y)| vector::distance(x, y));
        let largest = moves.fold(0.0, f64::max);
        let next = anderson.next(moving.as_flattened().to_vec(), images.as_flattened());
        moving.copy_from_slice(next.as_chunks().0);
        plain = Some(images);
        if largest < TOLERANCE {
            break;
        }
    }
}

/// All points but the lightest, in the coordinates of a frame, with the frame.
#[allow(clippy::type_complexity)]
fn standardised<const D: usize>(measure: &Measure<D>) -> (Vec<([f64; D], f64)>, Frame<D>) {
    let mut kept: Vec<([f64; D], f64)> = sound(measure).map(|(y, c)| (*y, *c)).collect();
    let mut sizes: Vec<f64> = kept.iter().map(|(_, c)| c.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let total: f64 = sizes.iter().sum();
    let mut sum = 0.0;
    let light = sizes.iter().find(|&&size| {
        sum += size;
        sum >= LEFT_OUT * total
    });
    let least = light.copied().unwrap_or(0.0);
    kept.retain(|(_, c)| c.abs() >= least);
    let frame = measure.frame();
    for (y, _) in &mut kept {
        *y = frame.to_reference(y);
    }
    (kept, frame)
}

#[cfg(test)]
mod tests {
    use parvi_targets::{SobolSequence, normal_quantile};

    use super::*;

    #[test]
    fn few_points_per_particle_are_iterated_as_often() {
        let points: Vec<[f64; 2]> = (0..400)
            .map(|i| [(f64::from(i) * 0.7).sin(), (f64::from(i) * 1.9).sin()])
            .collect();
        let measure = Measure::new(points, vec![1.0 / 400.0; 400]);
        let mut particles = condense(&measure, 50, 0.5);
        let frame = measure.frame();
        particles.iter_mut().for_each(|x| *x = frame.to_reference(x));
        let scaled: Vec<[f64; 2]> = measure.points.iter().map(|x| frame.to_reference(x)).collect();
        let (_, reached) = SupportPoints::new(&scaled, &measure.weights).moved(&particles);
        iterate(&SupportPoints::new(&scaled, &measure.weights), 200, &mut particles);
        let (_, least) = SupportPoints::new(&scaled, &measure.weights).moved(&particles);
        assert!(reached < least + 1e-4, "{reached} {least}");
    }

    #[test]
    fn pieces_keep_their_masses() {
        let points: Vec<[f64; 1]> = (0..100)
            .map(|i| [f64::from(i % 2) * 10.0 + f64::from(i) * 0.001])
            .collect();
        let weights: Vec<f64> = (0..100).map(|i| if i % 2 == 0 { 0.005 } else { 0.015 }).collect();
        let particles = condense(&Measure::new(points.clone(), weights), 40, 0.5);
        assert_eq!(particles.iter().filter(|x| x[0] > 5.0).count(), 30);
        assert!(condense(&Measure::new(points, vec![0.0; 100]), 40, 0.5).is_empty());
    }

    #[test]
    fn particles_of_a_flat_sample_lie_in_it() {
        let equal = Measure::new(vec![[1.0, 1.0]; 5], vec![0.2; 5]);
        assert_eq!(condense(&equal, 3, 0.5), [[1.0, 1.0]; 3]);
        let line = (0..100).map(|i| [f64::from(i), 0.1]).collect();
        let particles = condense(&Measure::new(line, vec![0.01; 100]), 10, 0.5);
        assert!(particles.iter().all(|x| x[1] == 0.1), "{particles:?}");
        assert!(
            particles.windows(2).any(|pair| (pair[0][0] - pair[1][0]).abs() > 1.0),
            "{particles:?}"
        );
    }

    #[test]
    fn particles_have_the_unit_of_the_points() {
        let points: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i).sin(), f64::from(3 * i).cos()]).collect();
        let of = |unit: f64| {
            let points = points.iter().map(|x| x.map(|c| unit * c)).collect();
            let particles = condense(&Measure::new(points, vec![0.01; 100]), 10, 0.5);
            particles.into_iter().map(|x| x.map(|c| c / unit)).collect::<Vec<_>>()
        };
        assert_eq!(of(2f64.powi(-700)), of(1.0));
    }

    /// Marginals of N(0, I) in bins of equal mass.
    #[test]
    fn cuts_leave_no_layers() {
        const BINS: usize = 20;
        let mut counts = [[0_u32; BINS]; 5];
        let edges: Vec<f64> = (1..BINS)
            .map(|edge| normal_quantile(edge as f64 / BINS as f64))
            .collect();
        for seed in 0..6 {
            let sequence = SobolSequence::scrambled(5, seed).unwrap();
            let normal = |index| {
                let mut u = [0.0; 5];
                sequence.write(index, &mut u);
                u.map(normal_quantile)
            };
            let points: Vec<[f64; 5]> = (0..20_000).map(normal).collect();
            let weights = vec![1.0 / points.len() as f64; points.len()];
            for x in condense(&Measure::new(points, weights), 1000, 0.5) {
                for (counts, x) in counts.iter_mut().zip(x) {
                    counts[edges.partition_point(|&edge| edge < x)] += 1;
                }
            }
        }
        let off = |count: &u32| (f64::from(*count) / 300.0 - 1.0).powi(2);
        let deviation = (counts.as_flattened().iter().map(off).sum::<f64>() / 100.0).sqrt();
        // Cuts across the axes alone: 0.088.
        assert!(deviation < 0.07, "{deviation}");
    }
}
