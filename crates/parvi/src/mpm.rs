//! The calibrated sampler.

use parvi_pool::PoolError;

use crate::cached_scores::CachedScores;
use crate::certificate::{Doubt, Outcome};
use crate::checkpoint::Journal;
use crate::mpm_body::Motion;
use crate::start::positive;
use crate::surveyed::Spent;
use crate::task::Task;
use crate::{Condensation, MpmOptions, SampleError, Samples, ScoreLocation, free_body, surveyed};

/// [`MpmOptions::sample`].
pub(crate) fn sample<const D: usize>(options: &MpmOptions, mut task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
    let Task { target, frame, run, .. } = task;
    run.checked_particles()?;
    let spacing = positive("spacing", options.spacing, 1.0)?;
    let motion = Motion::of(options, run.particles, spacing)?;
    let first_round = (motion.steps * run.particles) as u64;
    run.checked_start()?;
    let caches = options.score_location == ScoreLocation::Cached;
    let surveys = options.survey && options.annealing.last() == 1.0 && target.has_log_density() && !caches;
    run.given.check_taken("mpm", true)?;
    let mut journal = Journal::open(options, target, frame, run)?;
    if caches {
        let cached = CachedScores::new(target, frame, options.non_finite_scores, &journal.tape())?;
        if !cached.is_of_its_target() {
            return Err(journal.of_another_target());
        }
        journal.keep_evaluations(cached.tape());
        return free_body::sample(options, task.of(&cached), Some(&cached), u64::MAX, &mut journal);
    }
    if !surveys {
        return free_body::sample(options, task, None, u64::MAX, &mut journal);
    }
    if options.rounds == Some(0) {
        return surveyed::sample_as_it_is(options, Condensation::On, &mut task, &mut journal);
    }
    let (spent, nowhere) = match surveyed::sample(options, &mut task, &mut journal, first_round) {
        // A body may find what is too far for a survey.
        Err(SampleError::Pool(nowhere @ PoolError::NowhereFinite { points, scores, .. })) => {
            let densities = points;
            (Spent { densities, scores }, Some(nowhere))
        }
        surveyed => match surveyed? {
            Ok(samples) => return Ok(samples),
            Err(spent) => (spent, None),
        },
    };
    let left = spent.left(options);
    if let Some(nowhere) = nowhere.clone().filter(|_| left < first_round) {
        return Err(nowhere.into());
    }
    match (free_body::sample(options, task, None, left, &mut journal), nowhere) {
        // Where no density is finite, a score that is none is no news, and neither has the body found one.
        (Err(SampleError::ScoreNotFinite { .. }), Some(nowhere)) => Err(nowhere.into()),
        (Ok(mut samples), nowhere) => {
            if let Some(nowhere) = nowhere {
                let has_mass = |x: &[f64; D]| target.log_density(x).is_finite();
                let first = samples.positions.iter().position(has_mass).ok_or(nowhere)?;
                samples.density_evaluations += first as u64 + 1;
            }
            samples.density_evaluations += spent.densities;
            samples.score_evaluations += spent.scores;
            if let Some(certificate) = &mut samples.certificate {
                let evaluations = spent.evaluations();
                certificate.outcome = Outcome::Stalled(Doubt::SurveyInVain { evaluations });
            }
            Ok(samples)
        }
        (refused, _) => refused,
    }
}
