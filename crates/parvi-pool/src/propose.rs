//! The next proposal: Student kernels about resampled points, with covariances from neighbours or scores, refined, and as many and as wide as
//! points that did not shape them like best.

use mpm_tensor::{Matrix, vector};
use parvi_targets::normal_quantile;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::curvature::sharpened;
use crate::density::Density;
use crate::lanes::packed;
use crate::maximise::maximised;
use crate::mixture::{HALF_FREEDOM, Kernel, Mixture};
use crate::neighbours::local_covariances;
use crate::sample::{Sample, root};

/// Share of a local covariance's root that displaces the centre; the rest is left to the kernel.
const JITTER: f64 = 0.7;

/// Steps of expectation maximisation.
const ITERATIONS: usize = 4;

/// Widths that are tried, over the fitted ones.
const WIDTHS: [f64; 5] = [0.9, 1.0, 1.15, 1.35, 1.6];

/// Fewest and most kernels of one proposal.
const KERNELS: [usize; 2] = [8, 400];

/// Shares of the kernels twice and four times as wide, and of one as wide as the whole sample (whose root is stretched by the last number).
const WIDER: f64 = 0.08;
const WIDEST: f64 = 0.003;
pub(super) const WHOLE: f64 = 0.05;
const WHOLE_WIDTH: f64 = 1.5;

/// How many kernels a proposal has and how wide they are, over what the fit says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    pub kernels: usize,
    pub width: f64,
}

/// The kernels of one proposal before widening.
fn kernels<const D: usize>(
    sample: &Sample<D>,
    count: usize,
    rng: &mut ChaCha8Rng,
    scores: Option<(&mut Density<'_, D>, f64)>,
) -> Option<Mixture<D>> {
    let chosen = Sample::resampled(&sample.points, &sample.weights, count, rng.random());
    let repeated = chosen.points.iter().zip(&chosen.weights);
    let centres: Vec<[f64; D]> = repeated
        .flat_map(|(x, n)| std::iter::repeat_n(*x, *n as usize))
        .collect();
    let covariances = local_covariances(sample, &centres, 12 * D);
    // The covariance of t_ν is ν/(ν − 2) of its scale matrix.
    let normal = (1.0 - 1.0 / f64::from(HALF_FREEDOM)).sqrt();
    let jittered: Vec<Kernel<D>> = centres
        .iter()
        .zip(&covariances)
        .map(|(centre, covariance)| {
            let factor = root(covariance);
            let z = std::array::from_fn(|_| JITTER * normal_quantile(rng.random_range(1e-9..1.0)));
            Kernel {
                centre: vector::add(centre, &factor.apply(&z)),
                factor: factor * (normal * (1.0 - JITTER * JITTER).sqrt()),
                share: 1.0,
            }
        })
        .collect();
    let start = match scores {
        Some((density, gamma)) => {
            let centres: Vec<[f64; D]> = jittered.iter().map(|kernel| kernel.centre).collect();
            sharpened(density, &centres, &covariances, gamma)
        }
        None => jittered,
    };
    Some(maximised(sample, Mixture::new(start)?, ITERATIONS))
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
    let all = widened(1.0 - WIDER - WIDEST - WHOLE, 1.0)
        .chain(widened(WIDER, 2.0))
        .chain(widened(WIDEST, 4.0))
        .chain([whole]);
    Mixture::new(all.collect())
}

/// The form near the last one under which the points set aside are likeliest, Σ w log q(x).
pub(super) fn best_form<const D: usize>(sample: &Sample<D>, last: Form, rng: &mut ChaCha8Rng) -> Form {
    let [training, check] = sample.split();
    let groups = packed(&check.points);
    let (mut best, mut form) = (f64::NEG_INFINITY, last);
    for count in [last.kernels / 2, last.kernels, 2 * last.kernels] {
        let count = count.clamp(KERNELS[0], KERNELS[1]);
        let Some(fitted) = kernels(&training, (2 * count / 3).max(2), rng, None) else {
            continue;
        };
        for width in WIDTHS {
            let Some(proposal) = defended(&training, &fitted, width) else {
                continue;
            };
            let densities = proposal.densities(&groups);
            let logs = densities.as_flattened().iter().map(|q| q.max(f64::MIN_POSITIVE).ln());
            let score: f64 = check.weights.iter().zip(logs).map(|(w, log)| w * log).sum();
            if score > best {
                (best, form) = (score, Form { kernels: count, width });
            }
        }
    }
    form
}

/// The proposal of this form; with scores at the centres where `scores` hands the density and the power of the weights.
pub(super) fn proposal<const D: usize>(
    sample: &Sample<D>,
    form: Form,
    rng: &mut ChaCha8Rng,
    scores: Option<(&mut Density<'_, D>, f64)>,
) -> Option<Mixture<D>> {
    let fitted = kernels(sample, form.kernels, rng, scores)?;
    defended(sample, &fitted, form.width)
}

/// Before anything is known: one kernel as wide as the frame, one four and one sixteen times as wide.
pub(super) fn first<const D: usize>() -> Option<Mixture<D>> {
    let wide = |(width, share): (f64, f64)| Kernel {
        centre: [0.0; D],
        factor: Matrix::IDENTITY * width,
        share,
    };
    Mixture::new([(1.0, 0.3), (4.0, 0.5), (16.0, 0.2)].map(wide).to_vec())
}
