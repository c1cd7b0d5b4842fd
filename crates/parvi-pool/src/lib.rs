//! The pool: adaptive importance sampling over everything that was ever evaluated.
//!
//! Two folds of points take turns. The proposal of one is fitted to the points of the other: so no proposal bends towards the points that it is to weigh, and the
//! weights of everything evaluated, early points included, stay those of fresh points. At the end the proposals are frozen, and points that shaped none of them
//! give the evidence.

mod condense;
mod curvature;
mod density;
mod estimate;
mod fold;
mod gamma;
mod lanes;
mod levels;
mod maximise;
mod mixture;
mod neighbours;
mod options;
mod pareto;
mod propose;
mod referee;
mod sample;
#[cfg(test)]
mod tests;
mod weights;

pub use condense::condense;
pub use estimate::{Estimate, Pool};
pub use mixture::{Kernel, Mixture};
pub use options::{PoolError, PoolOptions, Round};
pub use pareto::pareto_k;
pub use referee::{Verdict, material};

use std::ops::ControlFlow;

use parvi_targets::{Frame, Target};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use density::Density;
use fold::Fold;
use levels::level_sample;
use propose::Form;
use sample::Sample;
use weights::{effective_size, tempered, tempering};

/// Stream of the pool's random numbers.
const STREAM: u64 = 9;

/// Weights are tempered to an effective size of this share of a fold, but at most to `LARGEST_TEMPERED`.
const TEMPERED_SHARE: f64 = 0.1;
const LARGEST_TEMPERED: f64 = 400.0;

/// and to no more than so many times the effective size without tempering, but at least to `SMALLEST_TEMPERED` per dimension.
const LARGEST_GROWTH: f64 = 4.0;
const SMALLEST_TEMPERED: f64 = 25.0;

/// Share of the points fitted to that come from a level set, and where the last round's effective share is above the bound.
const EXPLORING: f64 = 0.05;
const EXPLORING_LITTLE: f64 = 0.03;
const GOOD_SHARE: f64 = 0.4;

/// Tail of the weights above which adaptation goes on.
const LARGEST_TAIL: f64 = 0.6;

/// Points that a proposal is fitted to, at most.
const LARGEST_SAMPLE: usize = 3000;

/// Rounds whose proposals are frozen together.
const FROZEN_ROUNDS: usize = 3;

/// Explore a target with log density calls, and scores where weights alone are not sharp enough, until the effective size suffices or the evaluations are used up.
///
/// `frame`: what is known of place and scale, off by some units or a factor of ten. `given`: proposals to begin with beside the wide ones (fits, particles).
///
/// # Errors
/// [`PoolError`]: an option out of range, a target that is nowhere finite, or the observer's stop.
pub fn explore<const D: usize>(
    target: &dyn Target<D>,
    frame: &Frame<D>,
    given: &[Mixture<D>],
    particles: usize,
    seed: u64,
    options: &PoolOptions,
    observer: &mut dyn FnMut(&Round) -> ControlFlow<()>,
) -> Result<Pool<D>, PoolError> {
    let plan = options.plan::<D>(particles)?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(STREAM);
    let mut density = Density::new(target, frame);
    let mut folds = [Fold::new(), Fold::new()];
    begin(&mut folds, &mut density, given, plan.first, &mut rng)?;
    let mut form = Form {
        kernels: 25 * D,
        width: 1.0,
    };
    let mut share = 0.0;
    for number in 1.. {
        let size: f64 = folds.iter().map(Fold::effective_size).sum();
        let rest = plan.evaluations.saturating_sub(density.evaluations());
        let settled = share > GOOD_SHARE || folds.iter().all(has_light_tail) && share > options.sharpen_below;
        if size >= plan.adapted && settled || rest < plan.round as u64 + plan.referee as u64 {
            break;
        }
        let sharpens = D >= 3 && number > 2 && share < options.sharpen_below;
        let points = plan.round / 2;
        let exploring = if share > GOOD_SHARE {
            EXPLORING_LITTLE
        } else {
            EXPLORING
        };
        share = 0.0;
        for side in 0..2 {
            let [one, other] = &mut folds;
            let (fold, source) = if side == 0 { (one, other) } else { (other, one) };
            let (proposal, fitted) =
                propose(source, form, (sharpens, exploring), &mut density, &mut rng).ok_or(PoolError::NowhereFinite)?;
            form = fitted;
            share += 0.5 * fold.draw(&mut density, proposal, points, rng.random());
        }
        let round = Round {
            number,
            evaluations: density.evaluations(),
            effective_size: size,
            share,
            kernels: form.kernels,
            width: form.width,
            sharpened: sharpens,
        };
        if observer(&round).is_break() {
            return Err(PoolError::Interrupted { round: number });
        }
    }
    Ok(refereed(folds, density, frame, &plan, &mut rng))
}

/// Whether the weights of a fold have a tail that estimates may rest on.
fn has_light_tail<const D: usize>(fold: &Fold<D>) -> bool {
    pareto_k(&tempered(&fold.log_weights(), 1.0)).is_none_or(|k| k < LARGEST_TAIL)
}

/// The first points of both folds: of the wide proposal, and of those given.
fn begin<const D: usize>(
    folds: &mut [Fold<D>; 2],
    density: &mut Density<'_, D>,
    given: &[Mixture<D>],
    count: usize,
    rng: &mut ChaCha8Rng,
) -> Result<(), PoolError> {
    let wide = propose::first::<D>().ok_or(PoolError::NowhereFinite)?;
    for fold in &mut *folds {
        fold.draw(density, wide.clone(), count / 2, rng.random());
        for proposal in given {
            fold.draw(density, proposal.clone(), count / 4, rng.random());
        }
    }
    let found = folds
        .iter()
        .all(|fold| fold.log_densities.iter().any(|l| l.is_finite()));
    if found { Ok(()) } else { Err(PoolError::NowhereFinite) }
}

/// Temper the weights of a fold, and fit the other fold's next proposal to them.
fn propose<const D: usize>(
    source: &Fold<D>,
    form: Form,
    (sharpens, exploring): (bool, f64),
    density: &mut Density<'_, D>,
    rng: &mut ChaCha8Rng,
) -> Option<(Mixture<D>, Form)> {
    let logs = source.log_weights();
    let size = effective_size(&tempered(&logs, 1.0));
    // Beyond a few times what is there, tempering would bring back what the rounds have left behind.
    let wanted = (LARGEST_GROWTH * size).max(SMALLEST_TEMPERED * D as f64);
    let gamma = tempering(
        &logs,
        wanted.min(LARGEST_TEMPERED).min(TEMPERED_SHARE * logs.len() as f64),
    );
    let weights = tempered(&logs, gamma);
    let count = (2.0 * effective_size(&weights)) as usize;
    let count = count.clamp(500, LARGEST_SAMPLE);
    let mut sample = Sample::resampled(&source.positions, &weights, count, rng.random());
    sample.join(level_sample(source, (exploring * count as f64) as usize, rng.random()));
    if sharpens {
        let form = Form {
            kernels: 35 * D,
            width: 1.0,
        };
        return Some((propose::proposal(&sample, form, rng, Some((density, gamma)))?, form));
    }
    let form = propose::best_form(&sample, form, rng);
    Some((propose::proposal(&sample, form, rng, None)?, form))
}

/// Freeze the last proposals, and let fresh points of them give the evidence and join the pool.
fn refereed<const D: usize>(
    folds: [Fold<D>; 2],
    mut density: Density<'_, D>,
    frame: &Frame<D>,
    plan: &options::Plan,
    rng: &mut ChaCha8Rng,
) -> Pool<D> {
    let (mut kernels, mut wholes) = (Vec::new(), Vec::new());
    for fold in &folds {
        let last = fold.rounds.len().saturating_sub(FROZEN_ROUNDS);
        wholes.extend(
            fold.rounds[last..]
                .iter()
                .filter_map(|(_, proposal)| proposal.kernels().last())
                .copied(),
        );
        kernels.extend(
            fold.rounds[last..]
                .iter()
                .flat_map(|(_, proposal)| proposal.kernels())
                .copied(),
        );
    }
    let mut fresh = Fold::new();
    let adapted: f64 = folds.iter().map(Fold::effective_size).sum();
    if let Some(frozen) = Mixture::new(kernels) {
        let pilot = fresh.draw(&mut density, frozen.clone(), plan.referee, rng.random());
        // As many more as the effective size still lacks.
        let lacking = (plan.goal - adapted - pilot * plan.referee as f64).max(0.0) / pilot.max(0.01);
        let rest = plan.evaluations.saturating_sub(density.evaluations()) as f64;
        let more = lacking.min(rest).min(4.0 * adapted + 4.0 * plan.referee as f64) as usize;
        if more >= lanes::LANES {
            fresh.draw(&mut density, frozen, more, rng.random());
        }
    }
    let covered = covered(&fresh, wholes);
    Pool::new(folds, fresh, &covered, frame, &density)
}

/// Whether at the fresh points the kernels that stand for the sample as a whole are less than half of the frozen proposal.
fn covered<const D: usize>(fresh: &Fold<D>, wholes: Vec<Kernel<D>>) -> Vec<bool> {
    let groups = lanes::packed(&fresh.positions);
    let (Some((_, frozen)), Some(whole)) = (fresh.rounds.first(), Mixture::new(wholes)) else {
        return vec![false; fresh.positions.len()];
    };
    let (all, whole) = (frozen.densities(&groups), whole.densities(&groups));
    let pairs = all.as_flattened().iter().zip(whole.as_flattened());
    pairs
        .take(fresh.positions.len())
        .map(|(all, whole)| propose::WHOLE * whole < 0.5 * all)
        .collect()
}
