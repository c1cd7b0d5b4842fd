//! Kernels refined by expectation maximisation.

use mpm_tensor::{Matrix, vector};

use crate::lanes::{Group, LANES, packed};
use crate::mixture::Mixture;
use crate::order::near_together;
use crate::sample::{Sample, root};
use crate::student::{Kernel, Responsible, freedom};
use crate::weights::effective_size;

/// Points a kernel's first covariance counts for.
const PRIOR: f64 = 12.0;

/// Responsibilities below this are left out.
const SMALLEST: f64 = 1e-4;

/// A kernel whose responsibility for all of a group is below this at first is not asked again.
const FAR: f64 = 1e-6;

/// Groups of points that one task sums over.
const CHUNK: usize = 32;

/// A few steps of expectation maximisation of Σ w log q(x) over shares, centres and covariances of the mixture of t_ν kernels.
///
/// With responsibilities ρ and u = (ν + D)/(ν + r²): share ∝ Σ wρ, c = Σ wρu x / Σ wρu, Σ = (Σ wρu (x−c)(x−c)ᵀ + n₀ Ψ) / (Σ wρ + n₀), Ψ the kernel's
/// first covariance, n₀ = 12. G. J. McLachlan, D. Peel, *Finite Mixture Models*, 2000, §7.5; for importance sampling O. Cappé, R. Douc, A. Guillin,
/// J.-M. Marin, C. P. Robert, *Adaptive importance sampling in general mixture classes*, Stat. Comput. 18, 2008.
pub(super) fn maximised<const D: usize>(sample: &Sample<D>, start: Mixture<D>, iterations: usize) -> Mixture<D> {
    // In groups of points that are near each other few kernels matter.
    let mut points: Vec<([f64; D], f64)> = sample
        .points
        .iter()
        .copied()
        .zip(sample.weights.iter().copied())
        .collect();
    let covariance = sample.moments().1;
    let deviation = |axis: usize| covariance.0[axis][axis].sqrt().max(f64::MIN_POSITIVE);
    near_together(&mut points, &std::array::from_fn(deviation));
    let (points, weights): (Vec<[f64; D]>, Vec<f64>) = points.into_iter().unzip();
    let groups = packed(&points);
    let first: Vec<Matrix<D>> = start
        .kernels()
        .iter()
        .map(|k| k.factor * k.factor.transpose())
        .collect();
    // Weights in numbers of independent points.
    let unit = effective_size(&weights) / weights.iter().sum::<f64>();
    let weights: Vec<f64> = weights.iter().map(|w| unit * w).collect();
    let mut mixture = start;
    let all: Vec<u32> = (0..mixture.kernels().len() as u32).collect();
    let mut near = vec![all; groups.len()];
    for iteration in 0..iterations {
        let least = if iteration == 0 { FAR } else { SMALLEST };
        let sums = summed(&groups, &weights, &mixture, least, &mut near);
        let kernels = sums.iter().zip(&first).zip(mixture.kernels());
        let kernels = kernels.map(|((sums, first), old)| sums.kernel(old, first)).collect();
        match Mixture::new(kernels) {
            Some(next) if next.kernels().len() == first.len() => mixture = next,
            _ => break,
        }
    }
    mixture
}

/// Groups, their points' weights, and the kernels near each group.
type Task<'a, const D: usize> = ((&'a [Group<D>], &'a [f64]), &'a mut [Vec<u32>]);

/// The sums over all points, for every kernel. Of the kernels `near` a group only those stay in the list that have more than `least` of the density at one of
/// its points.
fn summed<const D: usize>(
    groups: &[Group<D>],
    weights: &[f64],
    mixture: &Mixture<D>,
    least: f64,
    near: &mut [Vec<u32>],
) -> Vec<Sums<D>> {
    let nu = f64::from(freedom(D));
    let count = mixture.kernels().len();
    let part = |((groups, weights), near): Task<'_, D>| {
        let mut sums = vec![Sums::<D>::default(); count];
        let mut responsible = Responsible::new(count);
        for ((group, weights), near) in groups.iter().zip(weights.chunks(LANES)).zip(near) {
            mixture.responsible(near, group, least, &mut responsible);
            for &place in &responsible.found {
                let kernel = near[place] as usize;
                let (squares, densities) = &responsible.each[place];
                let centre = &mixture.kernels()[kernel].centre;
                for lane in 0..weights.len() {
                    if densities[lane] > SMALLEST * responsible.totals[lane] {
                        let apart = std::array::from_fn(|axis| group[axis][lane] - centre[axis]);
                        let mass = weights[lane] * densities[lane] / responsible.totals[lane];
                        sums[kernel].add(mass, mass * (nu + D as f64) / (nu + squares[lane]), &apart);
                    }
                }
            }
            if least < SMALLEST {
                *near = responsible.found.iter().map(|&place| near[place]).collect();
            }
        }
        sums
    };
    let tasks = groups
        .chunks(CHUNK)
        .zip(weights.chunks(CHUNK * LANES))
        .zip(near.chunks_mut(CHUNK));
    let parts: Vec<Vec<Sums<D>>> = mpm_parallel::map(tasks, &part);
    let mut sums = vec![Sums::default(); count];
    for part in &parts {
        for (sum, part) in sums.iter_mut().zip(part) {
            sum.merge(part);
        }
    }
    sums
}

/// The sums of one kernel over the points: Σ wρ, Σ wρu, Σ wρu x, Σ wρu x xᵀ.
#[derive(Clone, Copy)]
struct Sums<const D: usize> {
    mass: f64,
    scaled: f64,
    first: [f64; D],
    second: Matrix<D>,
}

impl<const D: usize> Default for Sums<D> {
    fn default() -> Self {
        Self {
            mass: 0.0,
            scaled: 0.0,
            first: [0.0; D],
            second: Matrix::ZERO,
        }
    }
}

impl<const D: usize> Sums<D> {
    /// A point `x` from the centre with w ρ and w ρ u.
    fn add(&mut self, mass: f64, scaled: f64, x: &[f64; D]) {
        self.mass += mass;
        self.scaled += scaled;
        vector::accumulate(&mut self.first, scaled, x);
        for i in 0..D {
            vector::accumulate(&mut self.second.0[i], scaled * x[i], x);
        }
    }

    /// The kernel that these sums ask for.
    fn kernel(&self, old: &Kernel<D>, first: &Matrix<D>) -> Kernel<D> {
        let shift = vector::scale(&self.first, 1.0 / (self.scaled + f64::MIN_POSITIVE));
        let about_centre = self.second + Matrix::outer(&shift, &shift) * (-self.scaled);
        let covariance = (about_centre + *first * PRIOR) * (1.0 / (self.mass + PRIOR));
        Kernel {
            centre: vector::add(&old.centre, &shift),
            factor: root(&covariance.symmetric_part()),
            // No kernel dies out.
            share: self.mass + 0.1,
        }
    }

    fn merge(&mut self, other: &Self) {
        self.mass += other.mass;
        self.scaled += other.scaled;
        vector::accumulate(&mut self.first, 1.0, &other.first);
        self.second += other.second;
    }
}
