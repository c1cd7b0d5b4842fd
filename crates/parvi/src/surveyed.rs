//! The calibrated sampler on a target that is surveyed: evaluations are weighed, M particles are condensed from them, and the material
//! evens out what that leaves as far as it brings them nearer.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use mpm_tensor::{Matrix, vector};
use parvi_pool::{Beginning, Kernel, Mixture, Pool, PoolError, PoolOptions, Report, Round, explore};
use parvi_targets::Frame;
use rand::RngExt;

use crate::certificate::{Certificate, Doubt};
use crate::checkpoint::Journal;
use crate::driven::Driven;
use crate::polish::{Polish, Polished};
use crate::repetition::Repetition;
use crate::score_check::ScoreCheck;
use crate::start::Stream;
use crate::tails::Tails;
use crate::task::Task;
use crate::{Condensation, MpmOptions, Progress, Run, SampleError, Samples, Start, defaults};

/// A pool whose energy distance is known no better than that of so many times fewer independent draws than particles is none.
const WORTHLESS: f64 = 30.0;

/// How long evaluations may be without a place in the checkpoint.
const UNKEPT: Duration = Duration::from_secs(5);

/// What a survey took that is worth nothing.
#[derive(Default)]
pub(crate) struct Spent {
    pub densities: u64,
    pub scores: u64,
}

impl Spent {
    /// Evaluations of all kinds.
    pub fn evaluations(&self) -> u64 {
        self.densities + self.scores
    }

    /// What is left of the evaluations that were asked for; where none were said, there is no limit.
    pub fn left(&self, options: &MpmOptions) -> u64 {
        let limit = options.evaluations.unwrap_or(u64::MAX);
        limit.saturating_sub(self.evaluations())
    }
}

/// Only what it took where what was weighed is worth nothing and a body may try, whose first round takes so many evaluations. Where log p does not fall off, a body would find no end either.
pub(crate) fn sample<const D: usize>(
    options: &MpmOptions,
    task: &mut Task<'_, D>,
    journal: &mut Journal,
    first_round: u64,
) -> Result<Result<Samples<D>, Spent>, SampleError> {
    let pool = surveyed(options, task, journal)?;
    let tails = Tails::of(task.target, task.frame, &pool);
    let is_known = pool.measure.variance * (weighed_for(task) as f64) < WORTHLESS;
    let spent = Spent {
        densities: pool.density_evaluations + tails.densities,
        scores: pool.score_evaluations,
    };
    if is_known || tails.endless.is_some() || spent.left(options) < first_round {
        condensed(options, task, journal, pool, tails).map(Ok)
    } else {
        Ok(Err(spent))
    }
}

/// The same of any pool: who asks for the pool alone has it as it is, condensed or not.
pub(crate) fn sample_as_it_is<const D: usize>(
    options: &MpmOptions,
    condense: Condensation,
    task: &mut Task<'_, D>,
    journal: &mut Journal,
) -> Result<Samples<D>, SampleError> {
    let pool = surveyed(options, task, journal)?;
    let tails = Tails::of(task.target, task.frame, &pool);
    let (positions, weights) = match condense {
        Condensation::On => return condensed(options, task, journal, pool, tails),
        Condensation::Off => pool.weighing(),
        Condensation::Controlled => pool.controlled(),
    };
    let checks = Checks::of(task, &pool, tails);
    let mut points = Driven::at_rest(Vec::new(), positions);
    points.samples.weights = Some(weights);
    let count = weighed_for(task);
    Ok(judged(options, pool, count, &checks, Polished::still(points, 0)))
}

/// Particles from a pool, and what it says of them.
fn condensed<const D: usize>(
    options: &MpmOptions,
    task: &mut Task<'_, D>,
    journal: &mut Journal,
    pool: Pool<D>,
    tails: Tails,
) -> Result<Samples<D>, SampleError> {
    let checks = Checks::of(task, &pool, tails);
    // What is no gradient, or leads nowhere, moves nothing.
    let still = MpmOptions {
        rounds: Some(0),
        ..options.clone()
    };
    let moving = if checks.of_target.is_some() { &still } else { options };
    let polish = Polish::new(moving, task.target, &pool, task.run)?;
    let mut polished = polish.run(journal, task.observer)?;
    let samples = &mut polished.best.samples;
    samples.relative_energy_distance = (!options.weighted).then(|| polish.relative_distance(&samples.positions));
    samples.weights = options.weighted.then(|| pool.measure.shares(&samples.positions));
    Ok(judged(options, pool, task.run.particles, &checks, polished))
}

/// What is seen of a target and its pool before there are particles.
struct Checks {
    /// A reason not to move any.
    of_target: Option<Doubt>,
    /// Any reason.
    doubt: Option<Doubt>,
    spent: Spent,
}

impl Checks {
    fn of<const D: usize>(task: &Task<'_, D>, pool: &Pool<D>, tails: Tails) -> Self {
        let check = ScoreCheck::of(task.target, pool, &mut task.run.generator(Stream::Survey.of_body(1)));
        let repetition = Repetition::of(task.target, pool);
        let of_tails = tails.endless.map(|[rays, of]| Doubt::Endless { rays, of });
        // Of what is no function the others say nothing.
        let of_target = repetition.doubt.or(of_tails).or(check.doubt);
        Self {
            doubt: of_target
                .clone()
                .or(tails.spreadless.map(|[rays, of]| Doubt::Spreadless { rays, of })),
            of_target,
            spent: Spent {
                densities: check.densities + tails.densities + repetition.densities,
                scores: check.scores,
            },
        }
    }
}

/// Particles with what their pool says of so many.
fn judged<const D: usize>(
    options: &MpmOptions,
    pool: Pool<D>,
    particles: usize,
    checks: &Checks,
    polished: Polished<D>,
) -> Samples<D> {
    let Polished {
        best,
        spent,
        densities,
        steps,
    } = polished;
    let mut samples = best.samples;
    samples.steps = steps;
    samples.score_evaluations = spent + pool.score_evaluations + checks.spent.scores;
    samples.density_evaluations = densities + pool.density_evaluations + checks.spent.densities;
    let rest = (best.drift, best.kinetic_energy);
    samples.certificate = options
        .certificate
        .then(|| Certificate::of_pool(&pool, checks.doubt.clone(), (&samples, particles), rest));
    samples.log_evidence = Some(pool.log_evidence);
    // Where log p is no number there may be as much mass as elsewhere.
    samples.log_evidence_error = Some(pool.log_evidence_error.hypot(pool.verdict.undefined));
    samples.pareto_k = pool.verdict.pareto_k;
    samples.unseen = Some(pool.unseen());
    samples.pool = Some(Box::new(pool));
    samples
}

/// Particles that a pool is made for.
fn weighed_for<const D: usize>(task: &Task<'_, D>) -> usize {
    task.run.particles.min(defaults::LARGEST_POOL)
}

/// What was evaluated, weighed.
fn surveyed<const D: usize>(
    options: &MpmOptions,
    task: &mut Task<'_, D>,
    journal: &mut Journal,
) -> Result<Pool<D>, SampleError> {
    let count = weighed_for(task);
    let Task { target, frame, run, .. } = *task;
    let pool_options = PoolOptions {
        evaluations: options.evaluations,
        search_effort: options.search_effort,
        ..PoolOptions::default()
    };
    let seed = run.generator(Stream::Survey.of_body(0)).random();
    let given: Vec<Mixture<D>> = start_law(run, frame)?.into_iter().collect();
    let mut refused = None;
    let beginning = Beginning {
        frame,
        given: &given,
        tape: journal.tape(),
        seed,
    };
    let mut kept = Instant::now();
    let mut watch = |report: &Report<'_>| {
        let flow = match report.round {
            Some(&Round { number: step, .. }) => {
                // As many rounds as the evaluations that are left would do for.
                let whole = step as f64 * report.limit as f64 / report.evaluations.max(1) as f64;
                let steps = (whole as usize).max(step + 1);
                task.observer.after_step(Progress { step, steps })
            }
            None => task.observer.evaluated(report.evaluations, report.limit),
        };
        if report.round.is_some() || flow.is_break() || kept.elapsed() > UNKEPT {
            kept = Instant::now();
            if let Err(error) = journal.keep_tape(report.tape) {
                refused = Some(error);
                return ControlFlow::Break(());
            }
        }
        flow
    };
    let explored = explore(target, beginning, count, &pool_options, &mut watch);
    if let Some(error) = refused {
        return Err(error);
    }
    match explored {
        Ok(pool) => Ok(pool),
        Err(PoolError::Interrupted { round }) => Err(SampleError::Interrupted { step: round }),
        Err(PoolError::AnotherTape) => Err(journal.of_another_target()),
        Err(error) => Err(error.into()),
    }
}

/// In coordinates of the frame the law of the start, where the run has one of its own: the normal law of given positions, or that of `run.start`.
fn start_law<const D: usize>(run: &Run, frame: &Frame<D>) -> Result<Option<Mixture<D>>, SampleError> {
    run.given.check::<D>(run.particles)?;
    let (centre, factor) = if let Some(positions) = run.given.positions_in(frame) {
        let law = Frame::of_points(&positions, None).ok();
        let law = law.filter(|law| spreads(law, positions.len()));
        let law = law.ok_or(SampleError::StartWithoutSpread)?;
        (*law.centre(), *law.factor())
    } else if run.start == Start::default() {
        return Ok(None);
    } else {
        ([run.start.mean; D], Matrix::IDENTITY * run.start.standard_deviation)
    };
    let share = 1.0;
    Ok(Mixture::new(vec![Kernel { centre, factor, share }]))
}

/// Whether the law of so many points spreads along every direction, beyond what rounding leaves of points in a plane: the share of a variance that the axes before do not explain, and the
/// deviation beside the mean.
fn spreads<const D: usize>(law: &Frame<D>, points: usize) -> bool {
    let rows = law.factor().0;
    (0..D).all(|a| {
        let deviation = vector::norm(&rows[a]);
        rows[a][a] > 1e-6 * deviation && deviation > points as f64 * f64::EPSILON * law.centre()[a].abs()
    })
}
