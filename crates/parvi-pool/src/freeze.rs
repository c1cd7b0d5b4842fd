//! The end: a proposal from both folds together, frozen, and fresh points of it, which had no part in it.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::adapt::Adaptation;
use crate::density::Density;
use crate::fold::Fold;
use crate::lanes::{LANES, packed};
use crate::learn::learn;
use crate::mixture::{Kernel, Mixture};
use crate::options::{Plan, PoolOptions};
use crate::propose::{WHOLE, best_form, proposal};

/// Share of the points fitted to that come from a level set.
const EXPLORING: f64 = 0.03;

/// Share of the evaluations that walks may take.
const WALKING: f64 = 0.2;

/// The fold of fresh points, and whether they are covered.
pub(super) struct Frozen<const D: usize> {
    pub fresh: Fold<D>,
    pub covered: Vec<bool>,
}

/// Fits a proposal to the points of both folds and draws from it until the effective size suffices or the evaluations are used up.
pub(super) fn freeze<const D: usize>(
    adapted: &Adaptation<D>,
    density: &mut Density<'_, D>,
    plan: &Plan,
    options: &PoolOptions,
    rng: &mut ChaCha8Rng,
) -> Frozen<D> {
    let source = [&adapted.folds[0], &adapted.folds[1]];
    let walks = adapted.share < options.enrich_below;
    let walking = if walks {
        (WALKING * plan.evaluations as f64) as usize
    } else {
        0
    };
    let mut learned = learn(&source, EXPLORING, walking, density, rng);
    let form = best_form(&learned.sample, adapted.form, rng);
    learned.sample.join(learned.level);
    let mut fresh = Fold::new();
    let Some(frozen) = proposal(&learned.sample, form, rng) else {
        return Frozen {
            fresh,
            covered: Vec::new(),
        };
    };
    let whole = frozen.kernels().last().copied();
    let size: f64 = source.iter().map(|fold| fold.effective_size()).sum();
    let pilot = fresh.draw(density, frozen.clone(), plan.referee, rng.random());
    // As many more as the effective size still lacks.
    let lacking = (plan.goal - size - pilot * plan.referee as f64).max(0.0) / pilot.max(0.01);
    let rest = plan.evaluations.saturating_sub(density.evaluations()) as f64;
    let more = lacking.min(rest) as usize;
    if more >= LANES {
        fresh.draw(density, frozen, more, rng.random());
    }
    let covered = covered(&fresh, whole);
    Frozen { fresh, covered }
}

/// Whether at the fresh points the kernel that stands for the sample as a whole is less than half of the frozen proposal.
fn covered<const D: usize>(fresh: &Fold<D>, whole: Option<Kernel<D>>) -> Vec<bool> {
    let groups = packed(&fresh.positions);
    let (Some((_, frozen)), Some(whole)) = (fresh.rounds.first(), whole.and_then(|whole| Mixture::new(vec![whole])))
    else {
        return vec![false; fresh.positions.len()];
    };
    let (all, whole) = (frozen.densities(&groups), whole.densities(&groups));
    let pairs = all.as_flattened().iter().zip(whole.as_flattened());
    pairs
        .take(fresh.positions.len())
        .map(|(all, whole)| WHOLE * whole < 0.5 * all)
        .collect()
}
