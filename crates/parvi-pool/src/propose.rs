//! The next proposal: Student kernels fitted to a sample, as many and as wide as points that did not shape them like best.

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
/// points that q forgets, and the variance of the weights, which hangs on a few of them. As many kernels as the last time, half or twice as many; any number
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
    let (mut least, mut form) = (
        f64::INFINITY,
        Form {
            kernels: counts[0],
            width: 1.0,
        },
    );
    for kernels in counts {
        let Some(fitted) = fitted(&training, (2 * kernels).div_ceil(3), rng) else {
            continue;
        };
        for width in WIDTHS {
            let Some(proposal) = defended(&training, &fitted, width) else {
                continue;
            };
            let score = misfit(&check, proposal.densities(&groups).as_flattened());
            if score < least {
                (least, form) = (score, Form { kernels, width });
            }
        }
    }
    form
}

/// log Σ w (p/q)^{1/2} − log Σ w, up to a constant of p.
fn misfit<const D: usize>(sample: &Sample<D>, densities: &[f64]) -> f64 {
    let logs = sample.logs.iter().zip(densities);
    let logs: Vec<f64> = logs.map(|(p, q)| 0.5 * (p - q.max(f64::MIN_POSITIVE).ln())).collect();
    let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = sample.weights.iter().zip(&logs).map(|(w, l)| w * (l - top).exp()).sum();
    top + (sum / sample.weights.iter().sum::<f64>()).ln()
}

/// The proposal of this form.
pub(super) fn proposal<const D: usize>(sample: &Sample<D>, form: Form, rng: &mut ChaCha8Rng) -> Option<Mixture<D>> {
    defended(sample, &fitted(sample, form.kernels, rng)?, form.width)
}
