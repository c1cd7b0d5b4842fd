//! The next proposal: Student kernels fitted to a sample, as many and as wide as points that did not shape them like best.

use std::cmp::Ordering;

use mpm_tensor::{Matrix, vector};
use parvi_targets::normal_quantile;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::curvature::sharpened;
use crate::lanes::packed;
use crate::maximise::maximised;
use crate::mixture::Mixture;
use crate::neighbours::local_covariances;
use crate::sample::{Sample, root};
use crate::student::{Kernel, freedom};

/// Share of a local covariance's root that displaces the centre; the rest is left to the kernel.
const JITTER: f64 = 0.7;

/// Steps of expectation maximisation.
const ITERATIONS: usize = 6;

/// Widths that are tried, over the fitted ones.
const WIDTHS: [f64; 7] = [0.9, 1.0, 1.1, 1.2, 1.35, 1.6, 2.0];

/// Most kernels of one proposal, and the points that each of them needs.
const MOST_KERNELS: usize = 800;
const POINTS_PER_KERNEL: usize = 4;

/// Shares of the kernels twice and four times as wide, and of one as wide as the whole sample (whose root is stretched by the last number).
const WIDER: f64 = 0.08;
const WHOLE: f64 = 0.05;
const WHOLE_WIDTH: f64 = 1.5;

/// How many kernels a proposal has and how wide they are, over what the fit says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    pub kernels: usize,
    pub width: f64,
}

/// Kernels about resampled points, with covariances from their neighbours, refined.
fn fitted<const D: usize>(sample: &Sample<D>, count: usize, rng: &mut ChaCha8Rng) -> Option<Mixture<D>> {
    let chosen = sample.seats().resampled(count, rng.random());
    let neighbours = (12 * D).max(sample.points.len() / (2 * count.max(1)));
    let covariances: Vec<Matrix<D>> = local_covariances(sample, &chosen.points, neighbours)
        .iter()
        .zip(&chosen.precisions)
        .map(|(covariance, precision)| sharpened(covariance, &precision.unwrap_or(Matrix::ZERO)))
        .collect();
    let sharpens = sample.precisions.iter().any(Option::is_none);
    // The covariance of t_ν is ν/(ν − 2) of its scale matrix.
    let normal = (1.0 - 2.0 / f64::from(freedom(D))).sqrt();
    let jitter = if sharpens { 0.0 } else { JITTER };
    let kernel = |(centre, covariance)| {
        let factor = root(covariance);
        let z = std::array::from_fn(|_| jitter * normal_quantile(rng.random_range(1e-9..1.0)));
        Kernel {
            centre: vector::add(centre, &factor.apply(&z)),
            factor: factor * (normal * (1.0 - jitter * jitter).sqrt()),
            share: 1.0,
        }
    };
    let kernels = chosen.points.iter().zip(&covariances).map(kernel).collect();
    Some(maximised(sample, Mixture::new(kernels)?, ITERATIONS))
}

/// The kernels at this width, some twice as wide, and the whole sample as one kernel: what keeps weights bounded.
fn defended<const D: usize>(sample: &Sample<D>, fitted: &Mixture<D>, width: f64) -> Option<Mixture<D>> {
    let (mean, covariance) = sample.moments();
    let fitted = fitted.kernels();
    let widened = |share: f64, stretch: f64| {
        fitted.iter().map(move |kernel| Kernel {
            share: share * kernel.share,
            factor: kernel.factor * (stretch * width),
            ..*kernel
        })
    };
    let whole = Kernel {
        centre: mean,
        factor: root(&covariance) * WHOLE_WIDTH,
        share: WHOLE,
    };
    let all = widened(1.0 - WIDER - WHOLE, 1.0)
        .chain(widened(WIDER, 2.5).step_by(2))
        .chain([whole]);
    Some(Mixture::new(all.collect())?.with_core(fitted.len()))
}

/// The form under which points set aside come out best, by the least Σ w (p/q)^{1/2}: between the likelihood, which cares little for
/// points that q forgets, and the variance of the weights, which hangs on a few of them; of numbers of kernels that do as well the least. As many kernels as the last time, half or twice as many; any number
/// the first time, and one at every place of known curvature where scores sharpen them.
pub(super) fn best_form<const D: usize>(
    sample: &Sample<D>,
    last: Option<Form>,
    sharpens: bool,
    rng: &mut ChaCha8Rng,
) -> Form {
    let [training, check] = sample.split();
    let groups = packed(&check.points);
    let most = (sample.points.len() / POINTS_PER_KERNEL).clamp(1, MOST_KERNELS);
    let mut counts = match last {
        _ if sharpens => vec![sample.seats().points.len()],
        Some(form) => [form.kernels / 2, form.kernels, 2 * form.kernels, 4 * form.kernels]
            .map(|count| count.clamp(1, most))
            .to_vec(),
        None => std::iter::successors(Some(1), |count| Some(3 * count))
            .take_while(|&count| count <= most)
            .collect(),
    };
    counts.dedup();
    // Of every number of kernels the width that comes out best.
    let mut tried: Vec<Trial> = Vec::new();
    for kernels in counts {
        let Some(fitted) = fitted(&training, (2 * kernels).div_ceil(3), rng) else {
            continue;
        };
        let trial = |width| {
            let proposal = defended(&training, &fitted, width)?;
            Trial::of(
                Form { kernels, width },
                &check,
                proposal.densities(&groups).as_flattened(),
            )
        };
        tried.extend(WIDTHS.into_iter().filter_map(trial).min_by(Trial::compare));
    }
    let best = tried.iter().min_by(|one, other| one.compare(other));
    let chosen = best.and_then(|best| tried.iter().find(|trial| trial.is_as_good_as(best)));
    let fallback = Form { kernels: 1, width: 1.0 };
    chosen.map_or(fallback, |trial| trial.form)
}

/// How a proposal of this form fits points set aside.
struct Trial {
    form: Form,
    /// log Σ w (p/q)^{1/2}, up to a constant of w and p.
    misfit: f64,
    /// The share of every point in that sum.
    shares: Vec<f64>,
}

impl Trial {
    /// `None` where the sum is no number.
    fn of<const D: usize>(form: Form, sample: &Sample<D>, densities: &[f64]) -> Option<Self> {
        let logs = sample.logs.iter().zip(densities);
        let logs: Vec<f64> = logs.map(|(p, q)| 0.5 * (p - q.max(f64::MIN_POSITIVE).ln())).collect();
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let terms = sample.weights.iter().zip(&logs);
        let mut shares: Vec<f64> = terms.map(|(w, l)| w * (l - top).exp()).collect();
        let sum: f64 = shares.iter().sum();
        shares.iter_mut().for_each(|share| *share /= sum);
        let misfit = top + sum.ln();
        misfit.is_finite().then_some(Self { form, misfit, shares })
    }

    fn compare(&self, other: &Self) -> Ordering {
        self.misfit.total_cmp(&other.misfit)
    }

    /// Whether it fits no worse than the best one by more than one standard error of the difference, (Σ (s − s')²)^{1/2} with the shares s of the points:
    /// the rule by which the simplest of equally good models is taken (Breiman, Friedman, Olshen and Stone 1984, §3.4.3).
    fn is_as_good_as(&self, best: &Self) -> bool {
        let pairs = self.shares.iter().zip(&best.shares);
        let square: f64 = pairs.map(|(one, other)| (one - other).powi(2)).sum();
        self.misfit - best.misfit <= square.sqrt()
    }
}

/// The proposal of this form.
pub(super) fn proposal<const D: usize>(sample: &Sample<D>, form: Form, rng: &mut ChaCha8Rng) -> Option<Mixture<D>> {
    defended(sample, &fitted(sample, form.kernels, rng)?, form.width)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    /// Normal points of equal weight, bent by `bend` along the last axis, and their log density.
    fn sample(bend: f64, seed: u64) -> Sample<2> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut sample = Sample::default();
        for _ in 0..3000 {
            let z: [f64; 2] = std::array::from_fn(|_| normal_quantile(rng.random_range(1e-9..1.0)));
            sample.points.push([z[0], z[1] + bend * z[0] * z[0]]);
            sample.weights.push(1.0);
            sample.logs.push(-0.5 * vector::dot(&z, &z));
            sample.precisions.push(Some(Matrix::ZERO));
        }
        sample
    }

    fn kernels(bend: f64) -> Vec<usize> {
        let form = |seed| best_form(&sample(bend, seed), None, false, &mut ChaCha8Rng::seed_from_u64(seed));
        (0..5).map(|seed| form(seed).kernels).collect()
    }

    #[test]
    fn a_normal_law_needs_few_kernels() {
        let kernels = kernels(0.0);
        assert!(kernels.iter().all(|&count| count <= 9), "{kernels:?}");
    }

    #[test]
    fn a_bent_ridge_needs_many_kernels() {
        let kernels = kernels(3.0);
        assert!(kernels.iter().all(|&count| count >= 9), "{kernels:?}");
    }

    /// The difference of two misfits has an error of its own; what counts is not how large the shares are but how they differ.
    #[test]
    fn what_differs_by_less_than_its_error_is_as_good() {
        let trial = |misfit, shares: [f64; 3]| Trial {
            form: Form { kernels: 1, width: 1.0 },
            misfit,
            shares: shares.to_vec(),
        };
        let best = trial(0.0, [0.2, 0.3, 0.5]);
        let error = (0.1_f64.powi(2) + 0.1_f64.powi(2)).sqrt();
        assert!(trial(0.99 * error, [0.3, 0.3, 0.4]).is_as_good_as(&best));
        assert!(!trial(1.01 * error, [0.3, 0.3, 0.4]).is_as_good_as(&best));
        assert!(best.is_as_good_as(&best));
    }
}
