//! The pipeline: scouts, rounds of two folds, searches, a frozen proposal and its fresh points, until nothing objects.

use parvi_targets::Target;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use crate::adapt::Adaptation;
use crate::beginning::Beginning;
use crate::density::Density;
use crate::freeze::freeze;
use crate::mixture::Mixture;
use crate::options::{Plan, PoolError, PoolOptions};
use crate::pool::Pool;
use crate::referee::Objection;
use crate::report::Observer;
use crate::source::Source;

/// Streams of the pool's random numbers, of the scramblings of free draws, and of what reaches far out.
const STREAM: u64 = 9;
const FREE_DRAWS: u64 = 10;
const FAR: u64 = 11;

/// [`explore`](crate::explore), generated where it is called.
pub(crate) fn explore<const D: usize>(
    target: &dyn Target<D>,
    start: Beginning<'_, D>,
    particles: usize,
    options: &PoolOptions,
    observer: &mut Observer<'_>,
) -> Result<Pool<D>, PoolError> {
    let plan = options.plan::<D>(particles)?;
    let mut density = Density::new(Source::new(target, start.tape, Some(observer)), start.frame);
    let pool = explored(&mut density, start.given, particles, start.seed, plan);
    // A tape that has served for all of it.
    density.source.prove_tape();
    density.source.go_on()?;
    pool
}

/// Until nothing objects, or nothing is left.
fn explored<const D: usize>(
    density: &mut Density<'_, D>,
    given: &[Mixture<D>],
    particles: usize,
    seed: u64,
    mut plan: Plan,
) -> Result<Pool<D>, PoolError> {
    let [mut rng, mut scramblings, mut far] = [STREAM, FREE_DRAWS, FAR].map(|stream| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        rng
    });
    density.source.limit = plan.evaluations;
    let begun = Adaptation::begin(density, given, &plan, &mut rng);
    density.source.go_on()?;
    let mut adaptation = begun?;
    let mut is_due = false;
    // log Z and its error before proposals aimed at second moments.
    let mut aimed_at_the_target = None;
    loop {
        while is_due || !adaptation.is_over(&plan, density.evaluations()) {
            is_due = false;
            let round = adaptation.round(density, &plan, &mut rng);
            density.source.go_on()?;
            density.source.tell(Some(&round?));
            density.source.go_on()?;
        }
        let met = adaptation.search(density, &plan, &mut rng);
        density.source.go_on()?;
        if met {
            is_due = true;
            continue;
        }
        let frozen = freeze(&mut adaptation, density, &plan, &mut rng, &mut far);
        density.source.go_on()?;
        if !frozen.surprised || adaptation.is_used_up(&plan, density.evaluations()) {
            let pool = Pool::new(&adaptation, &frozen, density, (particles, &plan), &mut scramblings);
            let objection = pool.objection(particles);
            let is_final = matches!(objection, None | Some(Objection::Undefined(_)));
            let hanging = matches!(objection, Some(Objection::Hanging { .. }));
            if is_final || !plan.extend(hanging) {
                return Ok(match aimed_at_the_target {
                    Some(earlier) => pool.keeping(earlier),
                    None => pool,
                });
            }
            if hanging {
                aimed_at_the_target.get_or_insert((pool.log_evidence, pool.log_evidence_error));
            }
            density.source.limit = plan.evaluations;
            is_due = true;
        }
        adaptation.absorb(frozen.fresh, frozen.share);
    }
}
