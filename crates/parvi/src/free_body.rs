//! The calibrated sampler without a survey: one body that moves in the given frame from the given start.

use parvi_targets::Frame;

use crate::cached_scores::CachedScores;
use crate::certificate::{Certificate, LARGEST_DRIFT};
use crate::checkpoint::Journal;
use crate::driven::Driven;
use crate::extent::Extent;
use crate::mpm_body::Body;
use crate::start::{check, positive};
use crate::stein_discrepancy::{is_rough, squared_stein_discrepancy};
use crate::task::Task;
use crate::{MpmOptions, SampleError, Samples, defaults};

/// Spacing of a refining round over that of the one before.
const FINER: f64 = 0.5;

/// Where a body moves, and from where.
struct Departure<const D: usize> {
    frame: Frame<D>,
    positions: Vec<[f64; D]>,
    spacing: f64,
}

/// Rounds until the body is at rest or the next would take more than the `allowed` evaluations, further ones as long as `cached` scores, which the target then has, get better, and further ones at half of the spacing as long as a rough target gains
/// by them.
pub(crate) fn sample<const D: usize>(
    options: &MpmOptions,
    task: Task<'_, D>,
    cached: Option<&CachedScores<'_, D>>,
    allowed: u64,
    journal: &mut Journal,
) -> Result<Samples<D>, SampleError> {
    let (target, frame, run, observer) = task.parts();
    run.given.check_taken("mpm", true)?;
    let default = defaults::spacing::<D>(options.basis, run.particles);
    let mut departure = Departure {
        frame: *frame,
        positions: run.begin(frame)?,
        spacing: positive("spacing", options.spacing, default)?,
    };
    let last = checked_rounds(options)?;
    let (mut rounds, finer_caches) = (0..last, last..last + defaults::CACHE_ROUNDS);
    let mut moved = |departure: &Departure<D>, number, earlier_steps| {
        Body {
            options,
            target,
            frame: &departure.frame,
            run,
            number,
            earlier_steps,
            positions: departure.positions.clone(),
            journal,
            observer,
        }
        .run(departure.spacing)
    };
    let mut body = moved(&departure, rounds.next().unwrap_or(0), 0)?;
    let (mut evaluations, mut steps) = (body.samples.score_evaluations, body.samples.steps);
    let one_more = evaluations;
    while body.drift > LARGEST_DRIFT
        && evaluations + one_more <= allowed
        && let Some(round) = rounds.next()
    {
        departure = departure.further(body, 1.0);
        body = moved(&departure, round, steps)?;
        evaluations += body.samples.score_evaluations;
        steps += body.samples.steps;
    }
    if let Some(cached) = cached {
        let allowed = options
            .evaluations
            .unwrap_or_else(|| defaults::cache_evaluations(run.particles));
        for round in finer_caches {
            if !cached.test(&body.samples.positions, allowed).refined {
                break;
            }
            departure = departure.further(body, 1.0);
            body = moved(&departure, round, steps)?;
            steps += body.samples.steps;
        }
    }
    while options.spacing.is_none()
        && evaluations + one_more <= allowed
        && is_rough(&body.scores)
        && let Some(round) = rounds.next()
    {
        let finer = departure.further(body.clone(), FINER);
        let candidate = moved(&finer, round, steps)?;
        evaluations += candidate.samples.score_evaluations;
        steps += candidate.samples.steps;
        if squared_stein_discrepancy(&candidate) >= squared_stein_discrepancy(&body) {
            break;
        }
        (departure, body) = (finer, candidate);
    }
    let alpha = options.annealing.last();
    let certificate = options.certificate.then(|| Certificate::of_scores(&body, alpha));
    let (mut disagreement, mut scores_replaced) = (None, body.samples.scores_replaced);
    if let Some(cached) = cached {
        disagreement = Some(cached.test(&body.samples.positions, 0).disagreement);
        evaluations = cached.evaluations();
        scores_replaced = cached.replaced();
    }
    Ok(Samples {
        certificate,
        score_evaluations: evaluations,
        scores_replaced,
        score_disagreement: disagreement,
        steps,
        ..body.samples
    })
}

/// Rounds, at most: one where the number of steps is given and that of rounds is not.
fn checked_rounds(options: &MpmOptions) -> Result<usize, SampleError> {
    let default = if options.steps.is_some() { 1 } else { defaults::ROUNDS };
    let rounds = options.rounds.unwrap_or(default);
    check("rounds", rounds as f64, rounds >= 1, "at least 1")?;
    Ok(rounds)
}

impl<const D: usize> Departure<D> {
    /// On from where the body has come, in a frame of the particles' own mean and covariance where they have outgrown the old one, and at a
    /// spacing that is finer by a factor.
    fn further(&self, body: Driven<D>, finer: f64) -> Self {
        let (mut frame, mut positions) = (self.frame, body.positions);
        if Extent::of(&positions).outgrows_the_frame()
            && let Ok(own) = Frame::of_points(&body.samples.positions, None)
        {
            positions = body.samples.positions.iter().map(|x| own.to_reference(x)).collect();
            frame = own;
        }
        Self {
            frame,
            positions,
            spacing: self.spacing * finer,
        }
    }
}
