//! The No-U-Turn sampler of the crate `nuts-rs`: chains on threads, watched from the caller's.

use std::cell::Cell;
use std::collections::HashMap;
use std::fmt::Display;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use nuts_rs::{Chain, CpuLogpFunc, CpuMath, CpuMathError, DiagNutsSettings, HasDims, LogpError, Settings};
use parvi_targets::Target;
use rand::rngs::ChaCha8Rng;

use crate::drive::finite;
use crate::start::check;
use crate::task::Task;
use crate::{NutsOptions, Observer, Progress, SampleError, Samples};

/// Chain c draws from the stream of random numbers c + this.
const FIRST_STREAM: u64 = 16;

/// How long the caller's thread sleeps between two looks at the chains.
const WATCH: Duration = Duration::from_millis(20);

/// M draws over all chains of `options`, in the order of the chains; see [`NutsOptions::sample`].
pub(crate) fn sample<const D: usize>(options: &NutsOptions, task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
    let draws = task.run.particles_of("nuts")?;
    let acceptance = options.target_acceptance;
    check(
        "target acceptance",
        acceptance,
        acceptance > 0.0 && acceptance < 1.0,
        "above 0 and below 1",
    )?;
    check("thinning", options.thinning as f64, options.thinning >= 1, "at least 1")?;
    check("chains", options.chains as f64, options.chains >= 1, "at least 1")?;
    let chains = options.chains.min(draws);
    let warm_up = options.warm_up.checked_mul(chains);
    let total = draws
        .checked_mul(options.thinning)
        .and_then(|kept| kept.checked_add(warm_up?));
    let steps = total
        .filter(|total| u32::try_from(*total).is_ok())
        .ok_or(SampleError::InvalidOption {
            field: "draws of all chains",
            value: draws as f64 * options.thinning as f64 + options.warm_up as f64 * chains as f64,
            expected: "at most 2^32 - 1",
        })?;
    task.needs_log_density("method `nuts`")?;
    let (target, frame, run, observer) = task.parts();
    let starts = run.start_positions::<D>()?;
    let mut plans = Vec::with_capacity(chains);
    for (chain, z) in starts.iter().take(chains).enumerate() {
        let start = frame.to_target(z);
        check_start(target, &start)?;
        plans.push(Plan {
            chain,
            start: start.to_vec(),
            draws: draws / chains + usize::from(chain < draws % chains),
            generator: run.generator(FIRST_STREAM + chain as u64),
        });
    }
    let density = |x: &[f64], gradient: &mut [f64]| {
        let x = std::array::from_fn(|a| x[a]);
        gradient.copy_from_slice(&target.score(&x));
        target.log_density(&x)
    };
    let outcomes = run_all(options, &density, plans, steps, observer)?;
    let positions = outcomes
        .iter()
        .flat_map(|outcome| outcome.positions.as_chunks::<D>().0)
        .copied();
    Ok(Samples {
        positions: finite(positions.collect(), steps)?,
        steps,
        // One per chain looked whether it can begin.
        score_evaluations: chains as u64 + outcomes.iter().map(|outcome| outcome.evaluations).sum::<u64>(),
        divergences: Some(outcomes.iter().map(|outcome| outcome.divergences).sum()),
        ..Samples::default()
    })
}

/// A chain can begin only where log density and score are finite.
fn check_start<const D: usize>(target: &dyn Target<D>, start: &[f64; D]) -> Result<(), SampleError> {
    let (value, score) = (target.log_density(start), target.score(start));
    if !score.iter().all(|c| c.is_finite()) {
        return Err(SampleError::ScoreNotFinite {
            step: 0,
            position: start.to_vec(),
            score: score.to_vec(),
        });
    }
    if value.is_finite() {
        Ok(())
    } else {
        Err(SampleError::StartNotFinite {
            position: start.to_vec(),
            value,
        })
    }
}

/// log p at a point, whose gradient is written into the second slice.
type Density<'a> = &'a (dyn Fn(&[f64], &mut [f64]) -> f64 + Sync);

/// What one chain is to do.
struct Plan {
    chain: usize,
    start: Vec<f64>,
    /// Draws to keep.
    draws: usize,
    generator: ChaCha8Rng,
}

/// What one chain gave.
#[derive(Default)]
struct Outcome {
    /// The coordinates of the draws, one draw after the other.
    positions: Vec<f64>,
    evaluations: u64,
    divergences: usize,
}

/// Run all chains on as many threads as rayon would use and tell the observer of every draw, a little later.
fn run_all(
    options: &NutsOptions,
    density: Density<'_>,
    plans: Vec<Plan>,
    steps: usize,
    observer: &mut dyn Observer,
) -> Result<Vec<Outcome>, SampleError> {
    let count = plans.len();
    let workers = mpm_parallel::threads().clamp(1, count);
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let waiting = Mutex::new(plans.into_iter());
    let work = || {
        let mut finished = Vec::new();
        // Another worker's panic leaves the iterator as it was.
        while let Some(plan) = { waiting.lock().unwrap_or_else(PoisonError::into_inner).next() } {
            let chain = plan.chain;
            let after_draw = || {
                done.fetch_add(1, Ordering::Relaxed);
                !stop.load(Ordering::Relaxed)
            };
            finished.push((chain, run_chain(options, density, plan, after_draw)));
        }
        finished
    };
    let (alive, watch) = mpsc::channel::<()>();
    let parts = std::thread::scope(|scope| {
        let work = &work;
        let threads: Vec<_> = (0..workers)
            .map(|_| {
                let alive = alive.clone();
                scope.spawn(move || {
                    let _alive = alive;
                    work()
                })
            })
            .collect();
        drop(alive);
        let mut seen = 0;
        loop {
            let over = watch.recv_timeout(WATCH) == Err(RecvTimeoutError::Disconnected);
            let drawn = done.load(Ordering::Relaxed);
            while seen < drawn {
                seen += 1;
                if observer.after_step(Progress { step: seen, steps }).is_break() {
                    stop.store(true, Ordering::Relaxed);
                    return Err(SampleError::Interrupted { step: seen });
                }
            }
            if over {
                break;
            }
        }
        let panicked = |_| SampleError::Chain {
            chain: 0,
            reason: "a thread of the sampler ended in a panic".to_owned(),
        };
        let joined = threads.into_iter().map(|thread| thread.join().map_err(panicked));
        joined.collect::<Result<Vec<_>, _>>()
    })?;
    let mut finished: Vec<_> = parts.into_iter().flatten().collect();
    finished.sort_by_key(|(chain, _)| *chain);
    finished.into_iter().map(|(_, outcome)| outcome).collect()
}

/// Run one chain until `after_draw` says no.
fn run_chain(
    options: &NutsOptions,
    density: Density<'_>,
    mut plan: Plan,
    after_draw: impl Fn() -> bool,
) -> Result<Outcome, SampleError> {
    let kept = plan.draws * options.thinning;
    let mut settings = DiagNutsSettings {
        num_tune: options.warm_up as u64,
        num_draws: kept as u64,
        ..DiagNutsSettings::default()
    };
    settings.adapt_options.step_size_settings.target_accept = options.target_acceptance;
    let evaluations = Cell::new(0);
    let counted = CountedDensity {
        density,
        dimension: plan.start.len(),
        evaluations: &evaluations,
    };
    let chain = settings.new_chain(plan.chain as u64, CpuMath::new(counted), &mut plan.generator);
    let mut chain = chain.map_err(|error| failed(plan.chain, &error))?;
    chain
        .set_position(&plan.start)
        .map_err(|error| failed(plan.chain, &error))?;
    let mut outcome = Outcome::default();
    for draw in 0..options.warm_up + kept {
        let (position, progress) = chain.draw().map_err(|error| failed(plan.chain, &error))?;
        if let Some(kept) = draw.checked_sub(options.warm_up) {
            outcome.divergences += usize::from(progress.diverging);
            if (kept + 1) % options.thinning == 0 {
                outcome.positions.extend_from_slice(&position);
            }
        }
        if !after_draw() {
            break;
        }
    }
    outcome.evaluations = evaluations.get();
    Ok(outcome)
}

/// What the library said of a chain, with its causes.
fn failed(chain: usize, error: &impl Display) -> SampleError {
    SampleError::Chain {
        chain,
        reason: format!("{error:#}"),
    }
}

/// A density that counts how often it is asked.
struct CountedDensity<'a> {
    density: Density<'a>,
    dimension: usize,
    evaluations: &'a Cell<u64>,
}

/// Log density or gradient are not finite: the trajectory ends there, as a divergence.
#[derive(Debug, thiserror::Error)]
#[error("the log density or its gradient is not finite")]
struct NotFinite;

impl LogpError for NotFinite {
    fn is_recoverable(&self) -> bool {
        true
    }
}

impl HasDims for CountedDensity<'_> {
    fn dim_sizes(&self) -> HashMap<String, u64> {
        HashMap::from([("unconstrained_parameter".to_owned(), self.dimension as u64)])
    }
}

impl CpuLogpFunc for CountedDensity<'_> {
    type LogpError = NotFinite;
    type FlowParameters = ();
    type ExpandedVector = Vec<f64>;

    fn dim(&self) -> usize {
        self.dimension
    }

    fn logp(&mut self, position: &[f64], gradient: &mut [f64]) -> Result<f64, NotFinite> {
        self.evaluations.set(self.evaluations.get() + 1);
        let value = (self.density)(position, gradient);
        if value.is_finite() && gradient.iter().all(|c| c.is_finite()) {
            Ok(value)
        } else {
            Err(NotFinite)
        }
    }

    fn expand_vector<R: rand::Rng + ?Sized>(&mut self, _rng: &mut R, array: &[f64]) -> Result<Vec<f64>, CpuMathError> {
        Ok(array.to_vec())
    }
}
