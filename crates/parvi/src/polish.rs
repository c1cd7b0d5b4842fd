//! Particles evened out by the material, as far as that brings them nearer to what the pool knows.

use mpm_core::Particles;
use mpm_materials::IsothermalGas;
use mpm_tensor::vector;
use parvi_pool::Pool;
use parvi_targets::{Frame, Target};

use crate::basis_choice::Parts;
use crate::checkpoint::Journal;
use crate::compiled::Compiled;
use crate::drive::Driven;
use crate::framed_score::{FramedScore, ScoreForce};
use crate::moment_correction::correct_moments;
use crate::mpm_body::Body;
use crate::start::positive;
use crate::stein_discrepancy::squared_stein_discrepancy;
use crate::{MomentCorrection, MpmOptions, Observer, Run, SampleError, Samples, defaults};

/// Evens out particles that were condensed from a pool.
pub(crate) struct Polish<'a, const D: usize> {
    options: &'a MpmOptions,
    target: &'a dyn Target<D>,
    pool: &'a Pool<D>,
    run: &'a Run,
    /// The coordinates in which the body moves: those in which the pool has mean zero and covariance I.
    frame: Frame<D>,
    spacing: f64,
    /// Standard deviations of the pool, the units of energy distances.
    scales: [f64; D],
}

/// The best particles, and what all candidates took.
pub(crate) struct Polished<const D: usize> {
    pub best: Driven<D>,
    /// Evaluations of the score.
    pub spent: u64,
    pub steps: usize,
}

impl<'a, const D: usize> Polish<'a, D> {
    /// At the spacing asked for, or at one that follows the entropy power of the target.
    pub fn new(
        options: &'a MpmOptions,
        target: &'a dyn Target<D>,
        pool: &'a Pool<D>,
        run: &'a Run,
    ) -> Result<Self, SampleError> {
        let (mean, covariance) = pool.moments();
        let frame = Frame::new(mean, covariance).or_else(|_| {
            let spread = pool.measure.mean_and_deviation().1;
            Frame::from_scales(mean, spread.map(|s| if s > 0.0 { s } else { 1.0 }))
        });
        let default = defaults::polish_spacing::<D>(options.basis, run.particles, pool.entropy_power());
        Ok(Self {
            spacing: positive("spacing", options.spacing, default)?,
            frame: frame.unwrap_or_else(|_| Frame::identity()),
            scales: pool.measure.mean_and_deviation().1,
            options,
            target,
            pool,
            run,
        })
    }

    /// Moves the particles, twice as far every time, as long as that brings them nearer by what the pool and the scores can tell.
    ///
    /// Condensed particles follow the pool's noise, which is ν = Σ c² of an energy distance of E|Y − Y′|: they are nearer to it than to the target by ν, and others,
    /// which do not follow it, are farther from it than from the target by ν. So a candidate is taken if its energy distance to the pool exceeds theirs by less
    /// than 2ν, and if its kernel Stein discrepancy is no larger.
    pub fn run(&self, journal: &mut Journal, observer: &mut dyn Observer) -> Result<Polished<D>, SampleError> {
        let noise = self.pool.measure.variance * self.run.particles as f64;
        let rounds = match self.options.rounds {
            None if self.options.steps.is_none() && noise < defaults::least_polished_noise::<D>(self.run.particles) => {
                0
            }
            rounds => rounds.unwrap_or(defaults::POLISH_ROUNDS),
        };
        let mut best = self.condensed()?;
        let allowed = self.allowed(&best);
        let (mut spent, mut steps, mut planned) = (best.samples.score_evaluations, 0, defaults::POLISH_STEPS);
        for round in 0..rounds {
            let candidate = self.moved(&best, self.options.steps.unwrap_or(planned), round, journal, observer)?;
            spent += candidate.samples.score_evaluations;
            steps += candidate.samples.steps;
            let nearer = self.energy(&candidate) < allowed && discrepancy(&candidate) <= discrepancy(&best);
            if !nearer {
                break;
            }
            best = candidate;
            if noise < defaults::LARGEST_POOL_NOISE {
                break;
            }
            planned *= 2;
        }
        Ok(Polished { best, spent, steps })
    }

    /// The particles that the pool is condensed to, with their scores and the residual of these; without them for adaptive importance sampling alone.
    fn condensed(&self) -> Result<Driven<D>, SampleError> {
        let count = self.run.particles;
        let seen = if self.options.weighted {
            self.pool.flattened().condense(count)
        } else {
            self.pool.condense(count)
        };
        let positions: Vec<[f64; D]> = seen.iter().map(|x| self.frame.to_reference(x)).collect();
        let condensed = Driven {
            samples: Samples {
                positions: seen,
                ..Samples::default()
            },
            scores: Vec::new(),
            positions,
            drift: 0.0,
            kinetic_energy: 0.0,
        };
        if self.options.rounds == Some(0) {
            return Ok(condensed);
        }
        let correction = if self.pool.entropy_power() < defaults::LEAST_CORRECTED_ENTROPY_POWER || self.options.weighted
        {
            MomentCorrection::Off
        } else {
            self.options.moment_correction
        };
        let mut scored = self.scored(condensed.clone(), correction)?;
        if correction != MomentCorrection::Off && self.energy(&scored) > self.allowed(&condensed) {
            let spent = scored.samples.score_evaluations;
            scored = self.scored(condensed, MomentCorrection::Off)?;
            scored.samples.score_evaluations += spent;
        }
        Ok(scored)
    }

    /// Scores and residual of particles that no material has moved, with their moments put right.
    fn scored(&self, mut condensed: Driven<D>, correction: MomentCorrection) -> Result<Driven<D>, SampleError> {
        let mut score = FramedScore::new(self.target, &self.frame);
        score.non_finite = self.options.non_finite_scores;
        let parts = Parts {
            particles: Particles::at_rest(condensed.positions.clone(), 1.0),
            force: ScoreForce::at_particles(score),
            transfer: self.options.transfer,
            basis: self.options.basis,
            spacing: self.spacing,
        };
        let mut body = (Compiled::of().gas)(parts, IsothermalGas::new(1.0)?)?;
        let failed = |error| SampleError::in_step(0, error);
        let mut scores = vec![[0.0; D]; condensed.positions.len()];
        let score = &mut body.force().score;
        correct_moments(correction, &mut condensed.positions, score, &mut scores).map_err(failed)?;
        body.particles().positions.clone_from(&condensed.positions);
        let residual = body.residual(&[0.0; D], self.spacing, &scores).map_err(failed)?;
        let (score, samples) = (&body.force().score, &mut condensed.samples);
        (samples.score_evaluations, samples.scores_replaced) = (score.evaluations, score.replaced);
        (samples.residual, samples.spacing) = (Some(residual.ratio()), Some(self.spacing));
        samples.positions = condensed.positions.iter().map(|z| self.frame.to_target(z)).collect();
        condensed.scores = scores;
        Ok(condensed)
    }

    /// A body that begins where `from` is.
    fn moved(
        &self,
        from: &Driven<D>,
        steps: usize,
        number: usize,
        journal: &mut Journal,
        observer: &mut dyn Observer,
    ) -> Result<Driven<D>, SampleError> {
        if let Some(body) = journal.finished() {
            return Ok(body);
        }
        let options = MpmOptions {
            steps: Some(steps),
            moment_correction: MomentCorrection::Off,
            ..self.options.clone()
        };
        let body = Body {
            options: &options,
            target: self.target,
            frame: &self.frame,
            run: self.run,
            number,
            positions: from.positions.clone(),
            journal,
            observer,
        };
        let body = body.run(self.spacing)?;
        journal.finish(&body)?;
        Ok(body)
    }

    /// The largest energy of particles that may be nearer to the target than these, which were condensed.
    fn allowed(&self, condensed: &Driven<D>) -> f64 {
        let spread = mean_distance(&condensed.samples.positions, &self.scales);
        self.energy(condensed) + 2.0 * self.pool.measure.variance * spread
    }

    fn energy(&self, body: &Driven<D>) -> f64 {
        self.pool.measure.energy(&body.samples.positions, &self.scales)
    }
}

/// The squared kernel Stein discrepancy in the body's coordinates.
fn discrepancy<const D: usize>(body: &Driven<D>) -> f64 {
    squared_stein_discrepancy(&body.positions, &body.scores)
}

/// E|x − x′| over the particles, coordinates divided by `scales`.
fn mean_distance<const D: usize>(particles: &[[f64; D]], scales: &[f64; D]) -> f64 {
    let scaled = |x: &[f64; D]| -> [f64; D] { std::array::from_fn(|a| x[a] / scales[a]) };
    let (half, rest) = particles.split_at(particles.len() / 2);
    let pairs = half.iter().zip(rest.iter().rev());
    pairs
        .map(|(x, y)| vector::distance(&scaled(x), &scaled(y)))
        .sum::<f64>()
        / half.len().max(1) as f64
}
