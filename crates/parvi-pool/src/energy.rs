//! The energy distance of particles to a measure.

use std::ops::Range;

use mpm_tensor::vector;
use parvi_targets::{Frame, SobolSequence, normal_quantile};
use pulp::{Simd, WithSimd};

use crate::gamma::log_gamma_of_half;
use crate::lanes::{Group, LANES, Lanes, packed};
use crate::measure::Measure;

/// Directions of the projections that energies are taken from: on a plane they repeat themselves sooner than in space.
const fn direction_count(dimension: usize) -> usize {
    match dimension {
        1 => 1,
        2 => 32,
        _ => 64,
    }
}

/// Directions that tell whether parts are apart at all.
const FEW: usize = 16;

/// Bins of the measure along a direction: on a line particles come nearest to it, and there is one direction.
const fn bin_count(dimension: usize) -> usize {
    if dimension == 1 { 4096 } else { 1024 }
}

/// Numbers from here on are whole.
const WHOLE: f64 = (1_u64 << 52) as f64;

/// Groups of points whose places are found at a time.
const TOGETHER: usize = 16;

/// 2 E|x − Y| − E|x − x′| of particles x against a measure of Y: the energy distance up to a constant of the measure.
///
/// |x| is c_D times the mean of |⟨u, x⟩| over directions u, c_D = √π Γ((D + 1)/2)/Γ(D/2), so that the distance is that of projections, here on 64 of them at most,
/// always the same (A. Feuerverger, 1993; L. Baringhaus, C. Franz, *On a new multivariate two-sample test*, J. Multivar. Anal. 88, 2004). Along every one the
/// measure is counted in bins once, and M particles then take O(M log M).
#[derive(Clone, Debug)]
pub struct EnergyDistance<const D: usize> {
    frame: Frame<D>,
    projections: Vec<Projection<D>>,
}

/// Points and weights of a part of the measure.
type Part<const D: usize> = (Vec<Group<D>>, Vec<f64>);

impl<const D: usize> EnergyDistance<D> {
    /// From a measure, in the coordinates of a frame.
    pub fn new(measure: &Measure<D>, frame: Frame<D>) -> Self {
        Self::along(&directions(), measure, frame)
    }

    fn along(directions: &[[f64; D]], measure: &Measure<D>, frame: Frame<D>) -> Self {
        let part = |range: Range<usize>| -> Part<D> {
            let points = measure.points.get(range.clone()).unwrap_or_default().iter();
            let weights = measure.weights.get(range).unwrap_or_default().iter();
            let points = points.zip(weights).filter(|(_, c)| **c != 0.0);
            let (points, weights): (Vec<[f64; D]>, Vec<f64>) = points.map(|(y, c)| (frame.to_reference(y), *c)).unzip();
            (packed(&points), weights)
        };
        let parts: Vec<Part<D>> = measure.parts().map(part).collect();
        let projections = mpm_parallel::map(directions.iter(), &|u| Projection::new(*u, &parts));
        Self { frame, projections }
    }

    /// Of these particles.
    pub fn of(&self, particles: &[[f64; D]]) -> f64 {
        let particles: Vec<[f64; D]> = particles.iter().map(|x| self.frame.to_reference(x)).collect();
        self.mean(&|projection| projection.energy(&particles))
    }

    /// E|Y − Y′| of the measure: what the energy distance of particles is more than 2 E|x − Y| − E|x − x′|, negated.
    pub fn own(&self) -> f64 {
        self.mean(&Projection::own)
    }

    /// The energy distance of the measure from what it stands for, by how far its K independent parts are apart: Σ_k w_k ED²(Y_k, Y)/(K − 1), w_k the share of part k, which is that distance in
    /// expectation where shares go as the inverse of the parts' own ones (M. L. Rizzo, G. J. Székely, *DISCO analysis*, Ann. Appl. Stat. 4, 2010). Zero where there is one part.
    pub fn noise(&self) -> f64 {
        self.mean(&|projection| projection.noise)
    }

    /// c_D times the mean over the directions.
    fn mean(&self, of: &(dyn Fn(&Projection<D>) -> f64 + Sync)) -> f64 {
        let each = mpm_parallel::map(self.projections.iter(), of);
        let log_scale = log_gamma_of_half(D as u32 + 1) - log_gamma_of_half(D as u32);
        std::f64::consts::PI.sqrt() * log_scale.exp() * each.iter().sum::<f64>() / each.len().max(1) as f64
    }
}

impl<const D: usize> Measure<D> {
    /// How far its independent parts are apart, [`EnergyDistance::noise`] over E|Y − Y′|, over what the [`variance`](Self::variance) says: about one where the parts stand for the same,
    /// many times as much where one of them has lost a mode. NaN where there is no spread.
    pub fn inconsistency(&self) -> f64 {
        let directions = directions();
        let few = directions.len().min(FEW);
        let distance = EnergyDistance::along(&directions[..few], self, self.frame());
        distance.noise() / distance.own() / self.variance
    }
}

/// The measure along a direction: Σ c and Σ c s below the bottom of every bin, and in all; and its [noise](EnergyDistance::noise).
#[derive(Clone, Debug)]
struct Projection<const D: usize> {
    direction: [f64; D],
    below: Vec<[f64; 2]>,
    noise: f64,
}

impl<const D: usize> Projection<D> {
    fn new(direction: [f64; D], parts: &[Part<D>]) -> Self {
        let each: Vec<Vec<[f64; 2]>> = parts.iter().map(|part| below(&direction, part)).collect();
        let mut below = vec![[0.0; 2]; bin_count(D) + 1];
        for part in &each {
            for (sum, own) in below.iter_mut().zip(part) {
                *sum = vector::add(sum, own);
            }
        }
        Self {
            direction,
            noise: noise::<D>(&each, &below),
            below,
        }
    }

    /// 2 E|t − S| − E|t − t′| of the particles' projections t.
    fn energy(&self, particles: &[[f64; D]]) -> f64 {
        let mut places: Vec<f64> = particles.iter().map(|z| vector::dot(&self.direction, z)).collect();
        places.sort_unstable_by(f64::total_cmp);
        let count = places.len() as f64;
        let to_measure: f64 = places.iter().map(|&t| self.distance(t)).sum();
        let ranked = places.iter().enumerate();
        let to_others: f64 = ranked.map(|(rank, t)| (2.0 * rank as f64 + 1.0 - count) * t).sum();
        2.0 * (to_measure - to_others / count) / count
    }

    /// E|S − S′|; what is in one bin, evenly spread over it.
    fn own(&self) -> f64 {
        let bins = self.below.array_windows().enumerate();
        let of = |(bin, [[mass, sum], [next_mass, next_sum]]): (usize, &[[f64; 2]; 2])| {
            let (own, width) = (next_mass - mass, width::<D>(bin));
            let within = if width.is_finite() {
                own * own * width / 3.0
            } else {
                0.0
            };
            2.0 * (mass * (next_sum - sum) - sum * own) + within
        };
        bins.map(of).sum()
    }

    /// E|t − S|; what is in the bin of t, evenly spread over it: at u from its middle, of width w, w/4 + u²/w.
    fn distance(&self, t: f64) -> f64 {
        let bin = bin::<D>(t);
        let excess = |end: usize| self.below[end][0] * t - self.below[end][1];
        let (below, up_to, all) = (excess(bin), excess(bin + 1), excess(bin_count(D)));
        let (width, middle) = (width::<D>(bin), place::<D>(bin as f64 + 0.5));
        let own = if width.is_finite() {
            (self.below[bin + 1][0] - self.below[bin][0]) * (0.25 * width + (t - middle).powi(2) / width)
        } else {
            // As if all were on the other side of t than the middle, or on that.
            (t - middle).signum() * (up_to - below)
        };
        below - (all - up_to) + own
    }
}

/// Σ c and Σ c s below the bottom of every bin, and in all.
fn below<const D: usize>(direction: &[f64; D], (groups, weights): &Part<D>) -> Vec<[f64; 2]> {
    let mut below = vec![[0.0; 2]; bin_count(D) + 1];
    let mut places = [([0.0; LANES], [0.0; LANES]); TOGETHER];
    for (groups, weights) in groups.chunks(TOGETHER).zip(weights.chunks(TOGETHER * LANES)) {
        pulp::Arch::new().dispatch(Along {
            direction,
            groups,
            places: &mut places,
        });
        for ((places, bins), weights) in places.iter().zip(weights.chunks(LANES)) {
            for ((s, bin), c) in places.iter().zip(bins).zip(weights) {
                vector::accumulate(&mut below[numbered::<D>(*bin) + 1], *c, &[1.0, *s]);
            }
        }
    }
    for bin in 0..bin_count(D) {
        below[bin + 1] = vector::add(&below[bin], &below[bin + 1]);
    }
    below
}

/// Σ_k w_k 2 ∫ (F_k − F)² ds/(K − 1), F the distribution function along the direction: constant within a bin, and in the outermost ones it is none or all.
fn noise<const D: usize>(parts: &[Vec<[f64; 2]>], all: &[[f64; 2]]) -> f64 {
    if parts.len() < 2 {
        return 0.0;
    }
    let last = bin_count(D);
    let of = |part: &Vec<[f64; 2]>| {
        let share = part[last][0];
        let squares = (1..last).map(|end| {
            let width = place::<D>((end as f64 + 0.5).min(last as f64 - 0.5)) - place::<D>(end as f64 - 0.5);
            (part[end][0] / share - all[end][0]).powi(2) * width
        });
        2.0 * share * squares.sum::<f64>()
    };
    let distances: f64 = parts.iter().filter(|part| part[last][0] > 0.0).map(of).sum();
    distances / (parts.len() - 1) as f64
}

/// Places of points along a direction, and their bins.
struct Along<'a, const D: usize> {
    direction: &'a [f64; D],
    groups: &'a [Group<D>],
    places: &'a mut [(Lanes, Lanes)],
}

impl<const D: usize> WithSimd for Along<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (group, (places, bins)) in self.groups.iter().zip(self.places) {
            let (places, bins) = (S::as_mut_simd_f64s(places).0, S::as_mut_simd_f64s(bins).0);
            for part in 0..LANES / S::F64_LANES {
                let mut place = simd.splat_f64s(0.0);
                for axis in 0..D {
                    let coordinate = S::as_simd_f64s(&group[axis]).0[part];
                    place = simd.mul_add_e_f64s(simd.splat_f64s(self.direction[axis]), coordinate, place);
                }
                places[part] = place;
                bins[part] = bin_of::<_, D>(simd, place);
            }
        }
    }
}

/// Bins are of equal width in s/(1 + |s|): their numbers, in the lowest bits of a number beyond which every other one is whole.
#[inline(always)]
fn bin_of<S: Simd, const D: usize>(simd: S, place: S::f64s) -> S::f64s {
    let squeezed = simd.div_f64s(place, simd.add_f64s(simd.splat_f64s(1.0), simd.abs_f64s(place)));
    let half = 0.5 * bin_count(D) as f64;
    let bin = simd.mul_add_e_f64s(squeezed, simd.splat_f64s(half), simd.splat_f64s(half - 0.5));
    let kept = simd.min_f64s(
        simd.max_f64s(bin, simd.splat_f64s(0.0)),
        simd.splat_f64s((bin_count(D) - 1) as f64),
    );
    simd.add_f64s(kept, simd.splat_f64s(WHOLE))
}

fn bin<const D: usize>(s: f64) -> usize {
    numbered::<D>(bin_of::<_, D>(pulp::Scalar, s))
}

#[inline(always)]
fn numbered<const D: usize>(bin: f64) -> usize {
    bin.to_bits() as usize % bin_count(D)
}

fn width<const D: usize>(bin: usize) -> f64 {
    place::<D>(bin as f64 + 1.0) - place::<D>(bin as f64)
}

/// Where along the direction so many bins end.
fn place<const D: usize>(bins: f64) -> f64 {
    let squeezed = 2.0 * bins / bin_count(D) as f64 - 1.0;
    squeezed / (1.0 - squeezed.abs())
}

/// Quasi-random directions; in one dimension there is one.
fn directions<const D: usize>() -> Vec<[f64; D]> {
    if D == 1 {
        return vec![[1.0; D]];
    }
    let Ok(sequence) = SobolSequence::scrambled(D, 0) else {
        return Vec::new();
    };
    let direction = |index| {
        let mut u = [0.0; D];
        sequence.write(index, &mut u);
        let z = u.map(normal_quantile);
        vector::scale(&z, 1.0 / vector::norm(&z))
    };
    (0..direction_count(D) as u32).map(direction).collect()
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;

    use super::*;

    #[test]
    fn the_energy_is_that_of_all_pairs() {
        let wave = |n: usize, rate: f64| (rate * n as f64).sin();
        let points: Vec<[f64; 3]> = (0..40)
            .map(|n| [wave(n, 1.0), wave(n, 2.3), 2.0 * wave(n, 0.7)])
            .collect();
        let weights: Vec<f64> = (0..40).map(|n| (1.0 + wave(n, 3.0) * 1.2) / 40.0).collect();
        let total: f64 = weights.iter().sum();
        let weights: Vec<f64> = weights.iter().map(|c| c / total).collect();
        let particles: Vec<[f64; 3]> = (0..15).map(|n| [wave(n, 0.3), wave(n, 1.9), wave(n, 2.9)]).collect();
        let covariance = Matrix([[0.25, 0.3, 0.0], [0.3, 1.0, -0.5], [0.0, -0.5, 4.0]]);
        let frame = Frame::new([0.1, 0.2, 0.3], covariance).unwrap();
        let distance = |x: &[f64; 3], y: &[f64; 3]| vector::distance(&frame.to_reference(x), &frame.to_reference(y));
        let mean = |x: &[f64; 3]| -> f64 {
            let to_measure: f64 = points.iter().zip(&weights).map(|(y, c)| c * distance(x, y)).sum();
            let to_others: f64 = particles.iter().map(|y| distance(x, y)).sum();
            2.0 * to_measure - to_others / 15.0
        };
        let wanted = particles.iter().map(mean).sum::<f64>() / 15.0;
        let measure = Measure::new(points.clone(), weights.clone());
        let found = EnergyDistance::new(&measure, frame).of(&particles);
        assert!((found / wanted - 1.0).abs() < 0.02, "{found} {wanted}");
        let weighted = points.iter().zip(&weights);
        let from = |(x, c): (&[f64; 3], &f64)| c * weighted.clone().map(|(y, c)| c * distance(x, y)).sum::<f64>();
        let wanted: f64 = weighted.clone().map(from).sum();
        let found = EnergyDistance::new(&measure, frame).own();
        assert!((found / wanted - 1.0).abs() < 0.03, "{found} {wanted}");
    }

    /// Parts of quasi-random points on a line and in space, with shares and without a common centre: the distances of all pairs.
    #[test]
    fn noise_is_how_far_parts_are_apart() {
        let wave = |n: usize, rate: f64| (rate * n as f64 + 0.4).sin();
        let part = |first: usize, count: usize| {
            let points =
                (first..first + count).map(|n| [wave(n, 1.0), wave(n, 2.3), wave(n, 0.7) + 0.01 * first as f64]);
            Measure::<3>::new(points.collect(), vec![1.0 / count as f64; count])
        };
        let parts = [part(0, 20), part(20, 30), part(50, 25)];
        let shares = [0.7 * 0.6, 0.3 * 0.6, 0.4];
        let [first, second, third] = parts.clone();
        let all = first.mixed(0.3, second).mixed(0.4, third);
        let mean = |a: &Measure<3>, b: &Measure<3>| {
            let from =
                |x: &[f64; 3]| b.points.iter().map(|y| vector::distance(x, y)).sum::<f64>() / b.points.len() as f64;
            a.points.iter().map(from).sum::<f64>() / a.points.len() as f64
        };
        let mut wanted = 0.0;
        for i in 0..3 {
            for j in 0..i {
                let (a, b) = (&parts[i], &parts[j]);
                wanted += 0.5 * shares[i] * shares[j] * (2.0 * mean(a, b) - mean(a, a) - mean(b, b));
            }
        }
        let found = EnergyDistance::new(&all, Frame::identity()).noise();
        assert!((found / wanted - 1.0).abs() < 0.05, "{found} {wanted}");
        let alone = EnergyDistance::new(&parts[0], Frame::identity());
        assert_eq!(alone.noise(), 0.0);
        // The points are anyone's to change.
        let mut shorter = all;
        shorter.points.truncate(30);
        assert!(EnergyDistance::new(&shorter, Frame::identity()).noise() > 0.0);
    }

    #[test]
    fn on_a_line_bins_cost_no_accuracy_however_far_points_are() {
        let points: Vec<[f64; 1]> = (0..5000).map(|n| [(f64::from(n) * 0.7).tan()]).collect();
        let particles: Vec<[f64; 1]> = (0..50).map(|n| [(f64::from(n) * 1.3).sin() * 3.0]).collect();
        let mean = |x: f64, ys: &[[f64; 1]]| ys.iter().map(|y| (x - y[0]).abs()).sum::<f64>() / ys.len() as f64;
        let each = particles
            .iter()
            .map(|x| 2.0 * mean(x[0], &points) - mean(x[0], &particles));
        let wanted = each.sum::<f64>() / 50.0;
        let measure = Measure::new(points.clone(), vec![1.0 / 5000.0; 5000]);
        let found = EnergyDistance::new(&measure, Frame::identity()).of(&particles);
        assert!((found - wanted).abs() < 1e-6 * wanted, "{found} {wanted}");
    }
}
