#![doc = include_str!("../README.md")]

mod adapt;
mod anderson;
mod ascent;
mod compiled;
mod condense;
mod curvature;
mod density;
mod energy;
mod estimate;
mod fold;
mod freeze;
mod gamma;
mod lanes;
mod learn;
mod levels;
mod maximise;
mod measure;
mod mixture;
mod neighbours;
mod options;
mod pareto;
mod propose;
mod referee;
mod sample;
mod scout;
mod search;
mod summit;
mod support_points;
#[cfg(test)]
mod tests;
mod walk;
mod weights;

pub use condense::condense;
pub use energy::EnergyDistance;
pub use estimate::{Estimate, Pool};
pub use measure::Measure;
pub use mixture::{Kernel, Mixture};
pub use options::{PoolError, PoolOptions, Round};
pub use pareto::pareto_k;
pub use referee::{Objection, Verdict};

use std::ops::ControlFlow;

use parvi_targets::{Frame, Target};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use adapt::Adaptation;
use density::Density;
use freeze::freeze;

/// Stream of the pool's random numbers.
const STREAM: u64 = 9;

/// What is told after every round: the round, and every value of the target so far, in the order of evaluation.
pub type Observer<'a> = dyn FnMut(&Round, &[f64]) -> ControlFlow<()> + 'a;

/// Explore a target until the effective size suffices or the evaluations are used up.
///
/// `frame`: what is known of place and scale; scouts find what is off by powers of ten. `given`: proposals to begin with beside the scouts' (fits, particles).
/// `tape`: values of the target that an earlier process with the same arguments had told its observer; they are used instead of evaluating it again, and the
/// pool is the same to the bit.
///
/// # Errors
/// [`PoolError`]: an option out of range, a target that is nowhere finite, or the observer's stop.
#[allow(clippy::too_many_arguments)]
pub fn explore<const D: usize>(
    target: &dyn Target<D>,
    frame: &Frame<D>,
    given: &[Mixture<D>],
    tape: Vec<f64>,
    particles: usize,
    seed: u64,
    options: &PoolOptions,
    observer: &mut Observer<'_>,
) -> Result<Pool<D>, PoolError> {
    (compiled::Compiled::of().explore)(target, frame, given, tape, particles, seed, options, observer)
}

#[allow(clippy::too_many_arguments)]
fn explore_here<const D: usize>(
    target: &dyn Target<D>,
    frame: &Frame<D>,
    given: &[Mixture<D>],
    tape: Vec<f64>,
    particles: usize,
    seed: u64,
    options: &PoolOptions,
    observer: &mut Observer<'_>,
) -> Result<Pool<D>, PoolError> {
    let mut plan = options.plan::<D>(particles)?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(STREAM);
    let mut density = Density::new(target, frame, tape);
    let mut adaptation = Adaptation::begin(&mut density, given, &plan, &mut rng)?;
    let mut number = 0;
    let mut is_due = false;
    loop {
        while is_due || !adaptation.is_over(&plan, density.evaluations()) {
            is_due = false;
            number += 1;
            let round = adaptation.round(number, &mut density, &plan, &mut rng)?;
            if observer(&round, &density.tape).is_break() {
                return Err(PoolError::Interrupted { round: number });
            }
        }
        if adaptation.search(&mut density, &plan, &mut rng) {
            is_due = true;
            continue;
        }
        let frozen = freeze(&mut adaptation, &mut density, &plan, &mut rng);
        if !frozen.surprised || adaptation.is_used_up(&plan, density.evaluations()) {
            let pool = Pool::new(&adaptation.folds, &frozen, frame, &density, particles);
            if pool.objection(particles).is_none() || !plan.extend() {
                return Ok(pool);
            }
            is_due = true;
        }
        adaptation.absorb(frozen.fresh, frozen.share);
    }
}
