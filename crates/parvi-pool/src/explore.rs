//! The pipeline: scouts, rounds of two folds, searches, a frozen proposal and its fresh points, until nothing objects.

use std::ops::ControlFlow;

use parvi_targets::{Frame, Target};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use crate::adapt::Adaptation;
use crate::density::Density;
use crate::freeze::freeze;
use crate::mixture::Mixture;
use crate::options::{PoolError, PoolOptions, Round};
use crate::pool::Pool;
use crate::referee::Objection;

/// Stream of the pool's random numbers.
const STREAM: u64 = 9;

/// What is told after every round: the round, and every value of the target so far, in the order of evaluation.
pub type Observer<'a> = dyn FnMut(&Round, &[f64]) -> ControlFlow<()> + 'a;

/// [`explore`](crate::explore), generated where it is called.
#[allow(clippy::too_many_arguments)]
pub(crate) fn explore<const D: usize>(
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
            let pool = Pool::new(&adaptation, &frozen, frame, &density, particles);
            let is_final = matches!(pool.objection(particles), None | Some(Objection::Undefined(_)));
            if is_final || !plan.extend() {
                return Ok(pool);
            }
            is_due = true;
        }
        adaptation.absorb(frozen.fresh, frozen.share);
    }
}
