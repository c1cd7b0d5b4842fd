//! What a proposal is fitted to: resampled points of a fold, more of them by walks, and a few from a level set.

use mpm_tensor::Matrix;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::curvature::precisions;
use crate::density::Density;
use crate::enrich::{enriched, tempered_logs};
use crate::fold::Fold;
use crate::levels::level_sample;
use crate::neighbours::local_covariances;
use crate::sample::Sample;
use crate::weights::{effective_size, tempered, tempering};

/// Weights are tempered to an effective size of this share of the points, but at most to `LARGEST_TEMPERED`.
const TEMPERED_SHARE: f64 = 0.1;
const LARGEST_TEMPERED: f64 = 400.0;

/// and to no more than so many times the effective size without tempering, but at least to `SMALLEST_TEMPERED` per dimension.
const LARGEST_GROWTH: f64 = 4.0;
const SMALLEST_TEMPERED: f64 = 25.0;

/// Points resampled at least and at most.
const POINTS: [usize; 2] = [500, 10_000];

/// Walks at least, and moves of each at least.
const WALKS: usize = 50;
const MOVES: usize = 3;

/// Share of the walks that begin in a level set.
const LEVEL_WALKS: f64 = 0.3;

/// Neighbours per dimension that bound the length of a move.
const NEIGHBOURS: usize = 4;

/// A sample from the tempered weights, and one from a level set.
pub(super) struct Learned<const D: usize> {
    pub sample: Sample<D>,
    pub level: Sample<D>,
}

/// What these folds teach; `walking`: evaluations that walks may take, 0 for none; `exploring`: the level set's share.
pub(super) fn learn<const D: usize>(
    source: &[&Fold<D>],
    exploring: f64,
    walking: usize,
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
    let weights = tempered(&logs, gamma);
    let all = Sample {
        logs: tempered_logs(&points, &values, source, gamma),
        families: (0..points.len()).collect(),
        precisions: vec![Some(Matrix::ZERO); points.len()],
        points,
        weights,
    };
    let size = 2.0 * effective_size(&all.weights);
    let count = (size as usize).clamp(POINTS[0], POINTS[1]);
    let mut level = Sample::default();
    let mut add_level = |count: usize| {
        for fold in source {
            level.join(level_sample(fold, count / source.len(), rng.random()));
        }
        level.logs = tempered_logs(&level.points, &level.logs, source, gamma);
    };
    if walking == 0 {
        add_level((exploring * count as f64) as usize);
        let sample = all.resampled(count, rng.random());
        return Learned { sample, level };
    }
    let walks = (size as usize).clamp(WALKS, (walking / (D + 1 + MOVES)).max(WALKS));
    add_level((LEVEL_WALKS * walks as f64) as usize);
    let mut starts = all.resampled(walks - level.points.len().min(walks), rng.random());
    starts.join(level);
    let covariances = local_covariances(&starts, &starts.points, NEIGHBOURS * D);
    let before = density.evaluations();
    let found = precisions(density, &starts.points, &covariances);
    starts.precisions = found.into_iter().map(|precision| Some(precision * gamma)).collect();
    let moves = walking.saturating_sub((density.evaluations() - before) as usize) / walks;
    let sample = enriched(starts.repeated(), source, gamma, moves, density, rng);
    Learned { sample, level: Sample::default() }
}

/// Points, log densities and log weights of all folds; each estimates Z by itself, and they count by their effective sizes.
fn joined<const D: usize>(source: &[&Fold<D>]) -> (Vec<[f64; D]>, Vec<f64>, Vec<f64>) {
    let total: f64 = source.iter().map(|fold| fold.effective_size()).sum();
    let (mut points, mut values, mut logs) = (Vec::new(), Vec::new(), Vec::new());
    for fold in source {
        let share = (fold.effective_size() / total).ln();
        points.extend_from_slice(&fold.positions);
        values.extend_from_slice(&fold.log_densities);
        logs.extend(fold.log_weights().iter().map(|log| log + share));
    }
    (points, values, logs)
}
