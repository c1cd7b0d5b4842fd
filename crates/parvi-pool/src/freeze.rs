//! The end: a proposal from both folds together, frozen, and fresh points of it, which had no part in it.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::adapt::Adaptation;
use crate::density::Density;
use crate::fold::Fold;
use crate::lanes::{LANES, packed};
use crate::learn::{Manner, learn};
use crate::mixture::Mixture;
use crate::options::Plan;
use crate::propose::{best_form, proposal};
use crate::student::Kernel;

/// Share of the evaluations that scores for it may take.
const SHARPENING: f64 = 0.05;

/// Earlier proposals of each fold that are frozen too, and their share.
const EARLIER: usize = 6;
const EARLIER_SHARE: f64 = 0.4;

/// Share of kernels far out over the share of second moments that they stand for.
const FAR_SHARE: f64 = 0.5;

/// Effective share over that of the last rounds below which fresh points have met something that the rounds had not.
const SURPRISE: f64 = 0.4;

/// The fold of fresh points, and whether they are covered.
pub(super) struct Frozen<const D: usize> {
    pub fresh: Fold<D>,
    pub covered: Vec<bool>,
    /// Share of them at which the log density is NaN or +∞.
    pub undefined: f64,
    /// Effective share of the fresh points, and whether it says that adaptation ended too early.
    pub share: f64,
    pub surprised: bool,
}

/// Fits a proposal to the points of both folds and draws from it until the effective size suffices or the evaluations are used up.
pub(super) fn freeze<const D: usize>(
    adapted: &mut Adaptation<D>,
    density: &mut Density<'_, D>,
    plan: &Plan,
    rng: &mut ChaCha8Rng,
    far: &mut ChaCha8Rng,
) -> Frozen<D> {
    let source = [&adapted.folds[0], &adapted.folds[1]];
    let size: f64 = source.iter().map(|fold| fold.effective_size()).sum();
    let rest =
        |density: &Density<'_, D>| plan.evaluations.saturating_sub(density.evaluations()) as usize / LANES * LANES;
    let sharpening = plan.sharpening(adapted.share, size, SHARPENING).min(rest(density) / 4);
    let manner = Manner {
        hanging: plan.hanging,
        sharpening,
        walking: (rest(density) / 8) as u64,
    };
    let mut learned = learn(&source, manner, density, rng);
    let form = best_form(&learned.sample, adapted.form, sharpening > 0, rng);
    learned.sample.join(learned.level);
    adapted.forget_beginnings();
    let size: f64 = adapted.folds.iter().map(Fold::effective_size).sum();
    let mut fresh = Fold::new();
    let last = || adapted.folds[0].rounds.last().map(|(_, last)| last.clone());
    let Some(frozen) = proposal(&learned.sample, form, rng).or_else(last) else {
        return Frozen {
            fresh,
            covered: Vec::new(),
            undefined: 0.0,
            share: 0.0,
            surprised: false,
        };
    };
    let (frozen, wholes) = with_earlier(frozen, adapted);
    let far = adapted.reach(density, plan, far);
    let frozen = with_far(&frozen, &far).unwrap_or(frozen);
    let count = plan.referee.min(rest(density));
    let undefined = density.undefined;
    let pilot = fresh.draw(density, frozen.clone(), count, rng.random());
    // As many more as the effective size still lacks.
    let lacking = (plan.goal - size.min(plan.adapted) - pilot * count as f64).max(0.0) / pilot.max(0.01);
    let more = (lacking as usize).min(rest(density));
    if more >= LANES {
        fresh.draw(density, frozen, more, rng.random());
    }
    let share = fresh.effective_size() / fresh.positions.len().max(1) as f64;
    let [before, after] = [pilot.min(adapted.share), share];
    Frozen {
        covered: covered(&fresh, wholes),
        undefined: (density.undefined - undefined) as f64 / fresh.positions.len().max(1) as f64,
        fresh,
        share,
        surprised: after < SURPRISE * before,
    }
}

/// This proposal together with the last ones of both folds: a hole of one fit is none of all. Also the kernels that stand for samples as a whole.
fn with_earlier<const D: usize>(last: Mixture<D>, adapted: &Adaptation<D>) -> (Mixture<D>, Vec<Kernel<D>>) {
    let mut kernels = Vec::new();
    let mut wholes = Vec::new();
    let mut add = |proposal: &Mixture<D>, share: f64| {
        kernels.extend(proposal.shared(share));
        wholes.extend(proposal.shared(share).last());
    };
    add(&last, 1.0 - EARLIER_SHARE);
    let rounds = adapted.folds.iter().zip(&adapted.shares).flat_map(|(fold, shares)| {
        let first = fold.rounds.len().saturating_sub(EARLIER);
        fold.rounds[first..].iter().zip(&shares[first..])
    });
    let total: f64 = rounds.clone().map(|(_, share)| share).sum();
    for ((_, proposal), share) in rounds {
        add(proposal, EARLIER_SHARE * share / total.max(f64::MIN_POSITIVE));
    }
    let core = last.core_count();
    let all = Mixture::new(kernels).map(|all| all.with_core(core));
    (all.unwrap_or(last), wholes)
}

/// This proposal together with kernels far out, whose shares are those of the second moments there.
fn with_far<const D: usize>(frozen: &Mixture<D>, far: &[Kernel<D>]) -> Option<Mixture<D>> {
    let far = far.iter().map(|kernel| Kernel {
        share: FAR_SHARE * kernel.share,
        ..*kernel
    });
    let share: f64 = far.clone().map(|kernel| kernel.share).sum();
    let kernels = frozen.shared(1.0 - share.min(FAR_SHARE)).chain(far);
    Mixture::new(kernels.collect()).map(|all| all.with_core(frozen.core_count()))
}

/// Whether at the fresh points the kernels that stand for samples as a whole are less than half of the frozen proposal.
fn covered<const D: usize>(fresh: &Fold<D>, wholes: Vec<Kernel<D>>) -> Vec<bool> {
    let groups = packed(&fresh.positions);
    let share: f64 = wholes.iter().map(|kernel| kernel.share).sum();
    let (Some((_, frozen)), Some(whole)) = (fresh.rounds.first(), Mixture::new(wholes)) else {
        return vec![false; fresh.positions.len()];
    };
    let (all, whole) = (frozen.densities(&groups), whole.densities(&groups));
    let pairs = all.as_flattened().iter().zip(whole.as_flattened());
    pairs
        .take(fresh.positions.len())
        .map(|(all, whole)| share * whole < 0.5 * all)
        .collect()
}
