//! The calibrated sampler: a survey of the target, a body on each of its pieces, more rounds for bodies that are still on their way, and a
//! certificate.

use parvi_targets::{Frame, Target};

use crate::bodies::{InTurn, Knowledge, apportion, judged};
use crate::certificate::LARGEST_DRIFT;
use crate::checkpoint::Journal;
use crate::compiled::Compiled;
use crate::drive::Driven;
use crate::extent::Extent;
use crate::mpm_body::Body;
use crate::piece::Piece;
use crate::refinement::{FINER, is_rough, squared_stein_discrepancy};
use crate::start::{check, positive};
use crate::survey::{Site, Survey};
use crate::{MpmOptions, Observer, Run, SampleError, Samples, defaults};

/// Where a body moves, and from where.
struct Departure<const D: usize> {
    site: Site<D>,
    positions: Vec<[f64; D]>,
    /// Its spacing over the default one.
    fineness: f64,
}

/// What all bodies of a run share.
struct Common<'a, const D: usize> {
    options: &'a MpmOptions,
    target: &'a dyn Target<D>,
    run: &'a Run,
    /// The sites whose shares the pieces of the target are.
    sites: Vec<Site<D>>,
}

/// [`MpmOptions::sample`].
pub(crate) fn sample<const D: usize>(
    options: &MpmOptions,
    target: &dyn Target<D>,
    frame: &Frame<D>,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    run.checked_particles()?;
    options.spacing_schedule.check()?;
    options.settling.check()?;
    let rounds = options.checked_rounds()?;
    let start = run.start_positions()?;
    let mut journal = Journal::open(options, target, frame, run)?;
    let survey = if options.survey {
        Survey::new(target, frame, run, &start)?
    } else {
        Survey::skipped(frame)
    };
    let mut spent = survey.evaluations;
    let mut departures = options.placed(&survey.sites, run, survey.keeps_start.then_some(start))?;
    let common = Common {
        options,
        target,
        run,
        sites: departures.iter().map(|departure| departure.site.clone()).collect(),
    };
    let mut bodies = common.move_bodies(&departures, 0, &mut journal, observer)?;
    let mut rounds = 1..rounds;
    let mut steps = 0;
    while bodies.iter().any(|body| body.drift > LARGEST_DRIFT)
        && let Some(round) = rounds.next()
    {
        spent += evaluations(&bodies);
        steps += longest(&bodies);
        let further = departures.iter().zip(bodies);
        departures = further.map(|(departure, body)| departure.further(body, 1.0)).collect();
        bodies = common.move_bodies(&departures, round, &mut journal, observer)?;
    }
    while let ([departure], [body]) = (&departures[..], &bodies[..])
        && options.spacing.is_none()
        && is_rough(&body.scores)
        && let Some(round) = rounds.next()
    {
        let finer = vec![departure.further(body.clone(), FINER)];
        let moved = common.move_bodies(&finer, round, &mut journal, observer)?;
        let gains = discrepancy(&moved) < discrepancy(&bodies);
        let (taken, left) = if gains { (moved, bodies) } else { (bodies, moved) };
        spent += evaluations(&left);
        steps += longest(&left);
        bodies = taken;
        if !gains {
            break;
        }
        departures = finer;
    }
    let of_sites = |of: fn(&Site<D>) -> f64| departures.iter().map(|departure| of(&departure.site)).collect();
    let knowledge = Knowledge {
        masses: options.weighted.then(|| of_sites(|site| site.mass)),
        mass_errors: of_sites(|site| site.mass_error),
        mass_left_out: survey.sites.iter().map(|site| site.mass).sum::<f64>()
            - departures.iter().map(|departure| departure.site.mass).sum::<f64>(),
        alpha: options.annealing.last(),
        certificate: options.certificate,
        surveyed: options.survey,
    };
    let mut samples = judged(bodies, &knowledge);
    samples.score_evaluations += spent;
    samples.steps += steps;
    journal.close();
    Ok(samples)
}

impl MpmOptions {
    /// Sample `target`; `frame` is what is known of its place and scales, and the unit of the run's start law.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a score that is not finite, or the observer's stop.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        (Compiled::of().mpm)(self, target, frame, run, observer)
    }

    /// A departure from each site, of as many particles as its mass asks for (weighted: of equally many), from `start` (the only site's) or N(0, I) of its frame.
    fn placed<const D: usize>(
        &self,
        sites: &[Site<D>],
        run: &Run,
        mut start: Option<Vec<[f64; D]>>,
    ) -> Result<Vec<Departure<D>>, SampleError> {
        let departure = |(number, (site, count))| {
            let positions = match start.take() {
                Some(positions) => positions,
                None => run.standard_positions(count, number)?,
            };
            Ok(Departure {
                site,
                positions,
                fineness: 1.0,
            })
        };
        apportion(run.particles, sites, self.weighted)
            .into_iter()
            .enumerate()
            .map(departure)
            .collect()
    }

    /// Rounds, at most: one where the number of steps is given and that of rounds is not.
    fn checked_rounds(&self) -> Result<usize, SampleError> {
        let default = if self.steps.is_some() { 1 } else { defaults::ROUNDS };
        let rounds = self.rounds.unwrap_or(default);
        check("rounds", rounds as f64, rounds >= 1, "at least 1")?;
        Ok(rounds)
    }
}

impl<const D: usize> Common<'_, D> {
    /// Move a body from each of the departures, on its piece of the target where there are several sites.
    fn move_bodies(
        &self,
        departures: &[Departure<D>],
        round: usize,
        journal: &mut Journal,
        observer: &mut dyn Observer,
    ) -> Result<Vec<Driven<D>>, SampleError> {
        let Self {
            options,
            target,
            run,
            sites,
        } = self;
        let of = departures.len();
        let one = |(number, departure): (usize, &Departure<D>)| {
            if let Some(body) = journal.finished() {
                return Ok(body);
            }
            let (site, count) = (&departure.site, departure.positions.len());
            let default =
                defaults::spacing::<D>(options.basis, count) * defaults::tail_factor(site.tails) * departure.fineness;
            let spacing = positive("spacing", options.spacing, default)?;
            let piece = Piece {
                target: *target,
                sites,
                own: number,
            };
            let target: &dyn Target<D> = if of > 1 { &piece } else { *target };
            let moved = site.within(target, |target, frame| {
                let body = Body {
                    options,
                    target,
                    frame,
                    run,
                    number: number + of * round,
                    positions: departure.positions.clone(),
                    journal,
                    observer: &mut InTurn { number, of, observer },
                };
                body.run(spacing)
            });
            let body = match &site.map {
                Some(map) => map.driven(moved.map_err(|error| map.explained(error))?)?,
                None => moved?,
            };
            journal.finish(&body)?;
            Ok(body)
        };
        departures.iter().enumerate().map(one).collect()
    }
}

fn evaluations<const D: usize>(bodies: &[Driven<D>]) -> u64 {
    bodies.iter().map(|body| body.samples.score_evaluations).sum()
}

/// The squared kernel Stein discrepancies of all bodies, in the coordinates in which they moved.
fn discrepancy<const D: usize>(bodies: &[Driven<D>]) -> f64 {
    let of = |body: &Driven<D>| squared_stein_discrepancy(&body.positions, &body.scores);
    bodies.iter().map(of).sum()
}

/// Steps of the body that made most.
fn longest<const D: usize>(bodies: &[Driven<D>]) -> usize {
    bodies.iter().map(|body| body.samples.steps).max().unwrap_or(0)
}

impl<const D: usize> Departure<D> {
    /// On from where the body has come, in a frame of the particles' own mean and covariance where they have outgrown the old one, and at a
    /// spacing that is finer by a factor.
    fn further(&self, body: Driven<D>, finer: f64) -> Self {
        let mut site = self.site.clone();
        let mut positions = body.positions;
        if site.map.is_none()
            && Extent::of(&positions).outgrows_the_frame()
            && let Ok(frame) = Frame::of_points(&body.samples.positions, None)
        {
            positions = body.samples.positions.iter().map(|x| frame.to_reference(x)).collect();
            site.frame = frame;
        }
        Self {
            site,
            positions,
            fineness: self.fineness * finer,
        }
    }
}
