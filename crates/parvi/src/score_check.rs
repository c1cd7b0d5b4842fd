//! Whether the score is the gradient of log p, at a few points of a pool.

use mpm_tensor::vector;
use parvi_pool::Pool;
use parvi_targets::{Target, log_densities_in_calls, normal_quantile, scores_in_calls};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::certificate::Doubt;
use crate::drawn::drawn;

/// Points that are looked at, in one direction each.
const POINTS: usize = 8;

/// Steps of central differences, in standard deviations of the pool: where log p bends sharply short ones are right, and where it is rounded long ones.
const STEPS: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// Largest error of a score that passes, and of differences of two steps that know the slope, over the slope.
const LARGEST: f64 = 0.05;
const LARGEST_OF_DIFFERENCES: f64 = 0.02;

/// What a check has found, and what it took.
pub(crate) struct ScoreCheck {
    /// That the score is no number, or by how much it is not the gradient, over its size, where that is more than a twentieth.
    pub doubt: Option<Doubt>,
    /// Evaluations of the log density and of the score.
    pub densities: u64,
    pub scores: u64,
}

impl ScoreCheck {
    /// Compares the score s with central differences of log p at points drawn from the pool, each along a random direction v; the error is the median of |difference − s·v| over that of
    /// |difference|, for the step at which it is least.
    ///
    /// A score that is not finite where log p is about the point is no gradient. No error is found where no two differences agree, where log p is finite about fewer than half of the points, or where scores are
    /// estimates, which another call changes.
    pub fn of<const D: usize>(target: &dyn Target<D>, pool: &Pool<D>, rng: &mut ChaCha8Rng) -> Self {
        let factor = *pool.measure.frame().factor();
        let points = drawn(pool, POINTS, rng.random());
        let direction = |_: &[f64; D]| {
            let z = std::array::from_fn(|_| normal_quantile(rng.random_range(1e-9..1.0)));
            factor.apply(&vector::scale(&z, 1.0 / vector::norm(&z).max(f64::MIN_POSITIVE)))
        };
        let directions: Vec<[f64; D]> = points.iter().map(direction).collect();
        let [scores, again] = [(), ()].map(|()| scores_of(target, &points));
        let differences = STEPS.map(|step| differences(target, &points, &directions, step));
        let is_finite = |&index: &usize| differences.iter().all(|of_step| of_step[index].is_finite());
        let finite: Vec<usize> = (0..points.len()).filter(is_finite).collect();
        let slopes: Vec<f64> = scores.iter().zip(&directions).map(|(s, v)| vector::dot(s, v)).collect();
        let lacking = finite
            .iter()
            .filter(|&&index| !vector::is_finite(&scores[index]))
            .count();
        let is_known = are_same(&scores, &again) && 2 * finite.len() > points.len();
        let doubt = if lacking > 0 {
            let (points, of) = (lacking, finite.len());
            Some(Doubt::NoScore { points, of })
        } else if is_known {
            error(&slopes, &differences, &finite).map(|error| Doubt::Score { error })
        } else {
            None
        };
        Self {
            doubt,
            densities: 2 * (STEPS.len() * points.len()) as u64,
            scores: 2 * points.len() as u64,
        }
    }
}

/// What the target says at points.
pub(crate) fn scores_of<const D: usize>(target: &dyn Target<D>, points: &[[f64; D]]) -> Vec<[f64; D]> {
    let mut scores = vec![[0.0; D]; points.len()];
    scores_in_calls(target, points, &mut scores);
    scores
}

/// Whether scores are the same to the bit; NaN is NaN.
pub(crate) fn are_same<const D: usize>(some: &[[f64; D]], others: &[[f64; D]]) -> bool {
    let mut pairs = some.as_flattened().iter().zip(others.as_flattened());
    pairs.all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan())
}

/// The error of slopes beside differences of several steps, at these points; `None` where they pass, or where the differences know no better.
fn error(slopes: &[f64], differences: &[Vec<f64>], points: &[usize]) -> Option<f64> {
    let apart = |a: &[f64], b: &[f64]| median(points.iter().map(|&index| (a[index] - b[index]).abs()));
    let size = |a: &[f64]| median(points.iter().map(|&index| a[index].abs())).max(f64::MIN_POSITIVE);
    let errors = differences.iter().map(|of_step| apart(of_step, slopes) / size(of_step));
    let least = errors.fold(f64::INFINITY, f64::min);
    let agree = |[one, next]: &[Vec<f64>; 2]| apart(one, next) <= LARGEST_OF_DIFFERENCES * size(one);
    (least > LARGEST && differences.array_windows().any(agree)).then_some(least)
}

/// (log p(x + h v) − log p(x − h v)) / 2h.
fn differences<const D: usize>(
    target: &dyn Target<D>,
    points: &[[f64; D]],
    directions: &[[f64; D]],
    step: f64,
) -> Vec<f64> {
    let [above, below] = [step, -step].map(|step| {
        let moved = points.iter().zip(directions);
        let moved: Vec<[f64; D]> = moved.map(|(x, v)| vector::add_scaled(x, step, v)).collect();
        let mut values = vec![0.0; moved.len()];
        log_densities_in_calls(target, &moved, &mut values);
        values
    });
    above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * step)).collect()
}

/// The middle one of some numbers; NaN is the largest.
fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_unstable_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(0.0)
}
