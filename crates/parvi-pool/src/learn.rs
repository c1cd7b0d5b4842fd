//! What a proposal is fitted to: resampled points of a fold, more of them far out, the curvature at some of them, and a few from a level set.

use mpm_tensor::Matrix;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::curvature::precisions;
use crate::density::Density;
use crate::fold::{Fold, joined};
use crate::lanes::{LANES, packed};
use crate::levels::level_sample;
use crate::neighbours::local_covariances;
use crate::sample::Sample;
use crate::tilt::Tilt;
use crate::walk::outposts;
use crate::weights::{effective_size, systematic, tempered, tempering};

/// Weights are tempered to an effective size of this share of the points, but at most to `LARGEST_TEMPERED`.
const TEMPERED_SHARE: f64 = 0.1;
const LARGEST_TEMPERED: f64 = 400.0;

/// and to no more than so many times the effective size without tempering, but at least to `SMALLEST_TEMPERED` per dimension.
const LARGEST_GROWTH: f64 = 4.0;
const SMALLEST_TEMPERED: f64 = 25.0;

/// Points resampled at least and at most.
const POINTS: [usize; 2] = [500, 10_000];

/// Neighbours per dimension that bound the length of a move.
const NEIGHBOURS: usize = 4;

/// Share of the points learned from that come from a level set.
const EXPLORING: f64 = 0.12;

/// How far below the highest log density of the sample level sets and walks may go, over how far the lowest one is.
const DEPTH: f64 = 2.0;

/// A sample from the tempered weights, [tilted](Tilt), and one from a level set.
pub(super) struct Learned<const D: usize> {
    pub sample: Sample<D>,
    pub level: Sample<D>,
}

/// How to learn, and what may be spent on it beside the points that are there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Manner {
    /// Whether second moments are known to hang on few points.
    pub hanging: bool,
    /// Scores that the curvature at places for kernels may take, 0 for none.
    pub sharpening: usize,
    /// Evaluations that walks along ridges may take.
    pub walking: u64,
}

/// What these folds teach.
pub(super) fn learn<const D: usize>(
    source: &[&Fold<D>],
    manner: Manner,
    density: &mut Density<'_, D>,
    rng: &mut ChaCha8Rng,
) -> Learned<D> {
    let (points, values, logs) = joined(source);
    let size = effective_size(&tempered(&logs, 1.0));
    // Beyond a few times what is there, tempering would bring back what the rounds have left behind.
    let wanted = (LARGEST_GROWTH * size).max(SMALLEST_TEMPERED * D as f64);
    let gamma = tempering(
        &logs,
        wanted.min(LARGEST_TEMPERED).min(TEMPERED_SHARE * logs.len() as f64),
    );
    let mut weights = tempered(&logs, gamma);
    let tilt = Tilt::of(&points, &weights, manner.hanging);
    for (weight, x) in weights.iter_mut().zip(&points) {
        *weight *= tilt.log(x).exp();
    }
    let all = Sample {
        logs: values,
        precisions: vec![Some(Matrix::ZERO); points.len()],
        points,
        weights,
    };
    let size = 2.0 * effective_size(&all.weights);
    let count = (size as usize).clamp(POINTS[0], POINTS[1]);
    let mut sample = all.resampled(count, rng.random());
    let lowest = sample.logs.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = sample.logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lowest = highest - DEPTH * (highest - lowest);
    let mut level = Sample::default();
    for fold in source {
        let share = (EXPLORING * count as f64) as usize / source.len();
        level.join(level_sample(fold, lowest, share, rng.random()));
        level.join(outposts(
            fold,
            &sample,
            lowest,
            manner.walking / source.len() as u64,
            density,
        ));
    }
    for learned in [&mut sample, &mut level] {
        learned.logs = tempered_logs(&learned.points, &learned.logs, source, gamma);
        for (log, x) in learned.logs.iter_mut().zip(&learned.points) {
            *log += tilt.log(x);
        }
    }
    if manner.sharpening == 0 {
        return Learned { sample, level };
    }
    sample.join(level);
    let mut seats = systematic(&sample.weights, manner.sharpening / (D + 1), rng.random());
    seats.dedup();
    let points: Vec<[f64; D]> = seats.iter().map(|&i| sample.points[i]).collect();
    let covariances = local_covariances(&sample, &points, NEIGHBOURS * D);
    let found = precisions(density, &points, &covariances);
    sample.precisions = vec![None; sample.points.len()];
    for (i, precision) in seats.into_iter().zip(found) {
        sample.precisions[i] = Some(precision * gamma);
    }
    Learned {
        sample,
        level: Sample::default(),
    }
}

/// γ log p + (1 − γ) log q at points where log p is known, q the mixture of the folds.
fn tempered_logs<const D: usize>(points: &[[f64; D]], values: &[f64], source: &[&Fold<D>], gamma: f64) -> Vec<f64> {
    if gamma >= 1.0 {
        return values.to_vec();
    }
    let groups = packed(points);
    let folds = 1.0 / source.len() as f64;
    let mut densities = vec![[0.0; LANES]; groups.len()];
    for fold in source {
        fold.add_density(&groups, folds / fold.positions.len() as f64, &mut densities);
    }
    let pairs = values.iter().zip(densities.as_flattened());
    pairs
        .map(|(log, q)| gamma * log + (1.0 - gamma) * q.max(f64::MIN_POSITIVE).ln())
        .collect()
}
