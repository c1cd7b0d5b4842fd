//! A run on a target with the errors of its particles.

use parvi::{Method, Run};

use super::{Errors, Yardstick};
use crate::CommandError;
use crate::options::TargetSpecification;
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};
use crate::study::attempt::{Attempt, Status, attempt};
use crate::study::results::single_line;

/// What a run gave.
pub struct MeasuredRun {
    /// The particles and what the sampler says of them.
    pub outcome: Outcome,
    /// Their errors.
    pub errors: Attempt<Errors>,
    /// Whether the particles are independent draws from the importance sample of a target without exact ones.
    pub from_importance_sample: bool,
}

/// Samples a target and measures the particles; the yardstick is the target's.
///
/// # Errors
/// What [`attempt`] does not take for a result, and metrics that cannot be had.
pub fn measured_run(
    target: &TargetSpecification,
    method: &Method,
    run: &Run,
    yardstick: &dyn Yardstick,
    observer: &mut CaseObserver,
) -> Result<Attempt<MeasuredRun>, CommandError> {
    let from_importance_sample = *method == Method::Iid && !yardstick.has_exact_draws();
    let outcome = if from_importance_sample {
        yardstick.independent_draws(run.particles, run.seed)
    } else {
        match attempt(sampling::sample(target, method, run, observer))? {
            Attempt::Finished(outcome) => outcome,
            Attempt::Failed(status, reason) => return Ok(Attempt::Failed(status, reason)),
        }
    };
    Ok(Attempt::Finished(MeasuredRun {
        errors: measured(yardstick, &outcome)?,
        outcome,
        from_importance_sample,
    }))
}

/// The errors of particles; such as are so far out that a distance overflows have diverged.
///
/// # Errors
/// Metrics that cannot be had.
pub fn measured(yardstick: &dyn Yardstick, outcome: &Outcome) -> Result<Attempt<Errors>, CommandError> {
    match yardstick.measure(&outcome.particles) {
        Ok(errors) => Ok(Attempt::Finished(errors)),
        Err(CommandError::Metric(error)) => Ok(Attempt::Failed(Status::Diverged, single_line(error))),
        Err(error) => Err(error),
    }
}
