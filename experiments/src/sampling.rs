//! One run of a sampler on a target whose dimension is known at run time.

use std::time::Instant;

use parvi::{Certificate, Method, Observer, Run, TracePoint};
use parvi_targets::{BoxedTarget, CatalogueTarget};

use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::TargetSpecification;
use crate::output::Particles;

/// What a run gave; the fields are those of [`parvi::Samples`].
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// The particles, all finite.
    pub particles: Particles,
    /// Steps taken.
    pub steps: usize,
    /// Evaluations of the score at one point.
    pub score_evaluations: u64,
    /// Evaluations of the score at one point that only judged the particles, where they are counted apart.
    pub judging_evaluations: u64,
    /// Evaluations of the log density at one point.
    pub density_evaluations: u64,
    /// log Z, where the method estimates it.
    pub log_evidence: Option<f64>,
    /// Its standard error.
    pub log_evidence_error: Option<f64>,
    /// The same less the target's own, where that is known.
    pub log_evidence_deviation: Option<f64>,
    /// Shape of the tail of the importance weights.
    pub pareto_k: Option<f64>,
    /// [`Samples::score_disagreement`](parvi::Samples::score_disagreement).
    pub score_disagreement: Option<f64>,
    /// Residual relative to i.i.d. draws.
    pub residual: Option<f64>,
    /// Grid spacing in frame units.
    pub spacing: Option<f64>,
    /// Nodes with mass in the last step.
    pub active_nodes: Option<usize>,
    /// Bodies that moved.
    pub bodies: Option<usize>,
    /// Bytes held by particles and grid.
    pub storage_bytes: Option<usize>,
    /// Divergent trajectories of a Markov chain.
    pub divergences: Option<usize>,
    /// Scores that were not finite on the way and have been replaced.
    pub scores_replaced: u64,
    /// How good the particles are, as far as the method can tell.
    pub certificate: Option<Certificate>,
    /// Everything that was evaluated, weighed, with log p; where the method keeps it.
    pub pool: Option<Particles>,
    /// History.
    pub trace: Vec<TracePoint>,
    /// What a watch saw on the way.
    pub watched: Option<Watched>,
    /// Time of the sampler alone, in seconds.
    pub wall_seconds: f64,
}

/// The best configuration of a run, and all looks; as [`parvi::Watched`].
#[derive(Clone, Debug)]
pub struct Watched {
    /// The best configuration.
    pub best: Particles,
    /// Step after which it stood.
    pub best_step: usize,
    /// What the monitor said of it.
    pub best_value: f64,
    /// All looks: the step, and what the monitor said.
    pub history: Vec<(usize, f64)>,
    /// Whether the watch ended the run.
    pub ended: bool,
}

impl Watched {
    /// What the monitor said of the last configuration.
    pub fn last_value(&self) -> f64 {
        self.history.last().map_or(f64::NAN, |look| look.1)
    }
}

impl<const D: usize> From<parvi::Watched<D>> for Watched {
    fn from(seen: parvi::Watched<D>) -> Self {
        Self {
            best: Particles::new(&seen.positions, None),
            best_step: seen.step,
            best_value: seen.value,
            history: seen.history,
            ended: seen.ended,
        }
    }
}

impl Outcome {
    /// Particles that came without steps.
    pub fn of_draws(particles: Particles, wall_seconds: f64) -> Self {
        Self {
            particles,
            wall_seconds,
            ..Self::default()
        }
    }

    /// Evaluations of all kinds that the particles rest on.
    pub fn evaluations(&self) -> u64 {
        self.density_evaluations + self.score_evaluations
    }
}

fn finite(value: Option<f64>) -> Option<f64> {
    value.filter(|value| value.is_finite())
}

/// Samples a target of the catalogue.
///
/// # Errors
/// What the target or the sampler refuse; [`CommandError::NotFinite`] if a particle is not finite.
pub fn sample(
    target: &TargetSpecification,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Outcome, CommandError> {
    with_target(target, SampleTask { method, run, observer })
}

/// Samples a target that is already built.
pub fn sample_target<const D: usize>(
    target: &(dyn CatalogueTarget<D> + Sync),
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Outcome, CommandError> {
    let begin = Instant::now();
    let samples = parvi::sample::<D>(target, method, run, observer)?;
    let wall_seconds = begin.elapsed().as_secs_f64();
    let particles = Particles::from(&samples);
    if let Some(value) = particles.first_not_finite() {
        return Err(CommandError::NotFinite {
            what: "a particle".to_owned(),
            value,
        });
    }
    Ok(Outcome {
        particles,
        steps: samples.steps,
        score_evaluations: samples.score_evaluations,
        judging_evaluations: samples.judging_evaluations,
        density_evaluations: samples.density_evaluations,
        log_evidence: finite(samples.log_evidence),
        log_evidence_error: finite(samples.log_evidence_error),
        log_evidence_deviation: finite(
            samples
                .log_evidence
                .zip(target.log_evidence())
                .map(|(found, exact)| found - exact),
        ),
        pareto_k: finite(samples.pareto_k),
        score_disagreement: finite(samples.score_disagreement),
        residual: finite(samples.residual),
        spacing: finite(samples.spacing),
        active_nodes: samples.active_nodes,
        bodies: samples.bodies,
        storage_bytes: samples.storage_bytes,
        divergences: samples.divergences,
        scores_replaced: samples.scores_replaced,
        certificate: samples.certificate,
        pool: samples.pool.map(|pool| {
            let points = Particles::new(&pool.positions, Some(&pool.weights));
            points.with_log_densities(pool.log_densities)
        }),
        trace: samples.trace,
        watched: samples.watched.map(Watched::from),
        wall_seconds,
    })
}

struct SampleTask<'a> {
    method: &'a Method,
    run: &'a Run,
    observer: &'a mut dyn Observer,
}

impl TargetTask for SampleTask<'_> {
    type Output = Outcome;

    fn run<const D: usize>(self, target: BoxedTarget<D>) -> Result<Outcome, CommandError> {
        sample_target::<D>(target.as_ref(), self.method, self.run, self.observer)
    }
}
