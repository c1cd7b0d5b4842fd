//! The calibrated sampler.

use parvi_pool::PoolError;

use crate::cached_scores::CachedScores;
use crate::checkpoint::Journal;
use crate::mpm_body::Motion;
use crate::start::positive;
use crate::surveyed::Spent;
use crate::task::Task;
use crate::{MpmOptions, SampleError, Samples, ScoreLocation, free_body, surveyed};

/// [`MpmOptions::sample`].
pub(crate) fn sample<const D: usize>(options: &MpmOptions, mut task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
    let Task { target, frame, run, .. } = task;
    run.checked_particles()?;
    let spacing = positive("spacing", options.spacing, 1.0)?;
    Motion::of(options, run.particles, spacing)?;
    run.checked_start()?;
    let caches = options.score_location == ScoreLocation::Cached;
    let surveys = options.survey && options.annealing.last() == 1.0 && target.has_log_density() && !caches;
    let name = if surveys { "mpm with a survey" } else { "mpm" };
    run.given.check_taken(name, !surveys)?;
    let mut journal = Journal::open(options, target, frame, run)?;
    if surveys && options.rounds == Some(0) {
        return surveyed::sample_as_it_is(options, &mut task, &mut journal);
    }
    let mut nowhere = None;
    let mut spent = Spent::default();
    if surveys {
        match surveyed::sample(options, &mut task, &mut journal) {
            // A body may find what is too far for a survey.
            Err(SampleError::Pool(error @ PoolError::NowhereFinite { points, scores, .. })) => {
                nowhere = Some(error);
                spent = Spent {
                    densities: points,
                    scores,
                };
            }
            known => match known? {
                Ok(samples) => return Ok(samples),
                Err(in_vain) => spent = in_vain,
            },
        }
    }
    if caches {
        let cached = CachedScores::new(target, frame, options.non_finite_scores, &journal.tape())?;
        journal.keep_evaluations(cached.tape());
        return free_body::sample(options, task.of(&cached), Some(&cached), &mut journal);
    }
    let has_mass = |x: &[f64; D]| target.log_density(x).is_finite();
    match (free_body::sample(options, task, None, &mut journal), nowhere) {
        // Where no density is finite, a score that is none is no news, and neither has the body found one.
        (Err(SampleError::ScoreNotFinite { .. }), Some(nowhere)) => Err(nowhere.into()),
        (Ok(samples), Some(nowhere)) if !samples.positions.iter().any(has_mass) => Err(nowhere.into()),
        (Ok(samples), _) => Ok(Samples {
            density_evaluations: samples.density_evaluations + spent.densities,
            score_evaluations: samples.score_evaluations + spent.scores,
            ..samples
        }),
        (refused, _) => refused,
    }
}
