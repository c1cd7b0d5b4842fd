//! One run of a sampler on a target whose dimension is known at run time.

use std::time::Instant;

use parvi::{Method, Observer, Run};
use parvi_files::Outcome;
use parvi_options::TargetSpecification;
use parvi_targets::{CatalogueTarget, Frame};

use crate::CommandError;
use crate::dispatch::on_target;

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
    on_target!(target, target, D => sample_target::<D>(target.as_ref(), &target.frame(), method, run, observer))
}

/// What work with a target has given, unless the target has failed meanwhile: then everything rests on values that are none.
pub fn unless_failed<T, const D: usize>(
    target: &dyn CatalogueTarget<D>,
    worked: Result<T, CommandError>,
) -> Result<T, CommandError> {
    let failed = |fault| Err(CommandError::Library(Box::new(fault)));
    target.fault().map_or(worked, failed)
}

/// Samples a target that is already built, in a frame.
pub fn sample_target<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    frame: &Frame<D>,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Outcome, CommandError> {
    let begin = Instant::now();
    let samples = parvi::sample_in::<D>(target, frame, method, run, observer);
    let samples = unless_failed(target, samples.map_err(CommandError::from))?;
    let wall_seconds = begin.elapsed().as_secs_f64();
    let evidence = samples.log_evidence.zip(target.log_evidence());
    let mut outcome = Outcome {
        log_evidence_deviation: evidence.map(|(found, exact)| found - exact),
        wall_seconds,
        ..Outcome::from(samples)
    };
    if let Some(value) = outcome.particles.first_not_finite() {
        return Err(CommandError::NotFinite(value));
    }
    for number in [
        &mut outcome.log_evidence,
        &mut outcome.log_evidence_error,
        &mut outcome.log_evidence_deviation,
        &mut outcome.pareto_k,
        &mut outcome.unseen,
        &mut outcome.relative_energy_distance,
        &mut outcome.score_disagreement,
        &mut outcome.residual,
        &mut outcome.spacing,
    ] {
        *number = number.filter(|value| value.is_finite());
    }
    Ok(outcome)
}
