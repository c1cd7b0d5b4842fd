//! One run of a sampler on a target whose dimension is known at run time.

use std::time::Instant;

use parvi::{Method, Observer, Run, TracePoint};
use parvi_targets::{BoxedTarget, CatalogueTarget};

use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::TargetSpecification;
use crate::output::Particles;

/// What a run gave; the fields are those of [`parvi::Samples`].
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The particles, all finite.
    pub particles: Particles,
    /// Steps taken.
    pub steps: usize,
    /// Evaluations of the score at one point.
    pub score_evaluations: u64,
    /// What the sampler says of its own particles, e.g. `converged`; `None` where it says nothing.
    pub outcome: Option<String>,
    /// Residual relative to i.i.d. draws.
    pub residual: Option<f64>,
    /// Grid spacing in frame units.
    pub spacing: Option<f64>,
    /// Nodes with mass in the last step.
    pub active_nodes: Option<usize>,
    /// Bodies that moved, each on a separate piece of the target.
    pub bodies: Option<usize>,
    /// Bytes held by particles and grid.
    pub storage_bytes: Option<usize>,
    /// Divergent trajectories of a Markov chain.
    pub divergences: Option<usize>,
    /// History.
    pub trace: Vec<TracePoint>,
    /// Time of the sampler alone, in seconds.
    pub wall_seconds: f64,
}

impl Outcome {
    /// Particles that came without steps.
    pub fn of_draws(particles: Particles, wall_seconds: f64) -> Self {
        Self {
            particles,
            steps: 0,
            score_evaluations: 0,
            outcome: None,
            residual: None,
            spacing: None,
            active_nodes: None,
            bodies: None,
            storage_bytes: None,
            divergences: None,
            trace: Vec::new(),
            wall_seconds,
        }
    }
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
        outcome: None,
        residual: samples.residual.filter(|value| value.is_finite()),
        spacing: samples.spacing.filter(|value| value.is_finite()),
        active_nodes: samples.active_nodes,
        bodies: samples.bodies,
        storage_bytes: samples.storage_bytes,
        divergences: samples.divergences,
        trace: samples.trace,
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
