//! Particles evened out by the material, as far as that brings them nearer to what the pool knows.

use mpm_core::Particles;
use mpm_materials::IsothermalGas;
use mpm_tensor::vector;
use parvi_body::{FramedScore, Parts, ScoreForce};
use parvi_pool::{EnergyDistance, Pool};
use parvi_targets::{Frame, Target};

use crate::checkpoint::Journal;
use crate::driven::Driven;
use crate::moment_correction::{correct_moments, standardise};
use crate::mpm_body::{Body, Unfinished};
use crate::start::positive;
use crate::stein_discrepancy::squared_stein_discrepancy;
use crate::{MomentCorrection, MpmOptions, NonFiniteScores, Observer, Run, SampleError, Samples, defaults};

/// Evens out particles that were condensed from a pool.
pub(crate) struct Polish<'a, const D: usize> {
    options: &'a MpmOptions,
    target: &'a dyn Target<D>,
    pool: &'a Pool<D>,
    run: &'a Run,
    /// The coordinates in which the body moves and energy distances are taken: those in which the pool has mean zero and covariance I.
    frame: Frame<D>,
    distance: EnergyDistance<D>,
    spacing: f64,
    entropy_power: f64,
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
        let frame = pool.measure.frame();
        let entropy_power = pool.entropy_power();
        let default = defaults::polish_spacing::<D>(options.basis, run.particles, entropy_power);
        Ok(Self {
            spacing: positive("spacing", options.spacing, default)?,
            distance: EnergyDistance::new(&pool.measure, frame),
            frame,
            entropy_power,
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
    /// than 2ν, and if its kernel Stein discrepancy is no larger; one that ends where a score is not finite is not.
    pub fn run(&self, journal: &mut Journal, observer: &mut dyn Observer) -> Result<Polished<D>, SampleError> {
        let condensed = self.condensed();
        if self.options.rounds == Some(0) {
            return Ok(Polished {
                best: condensed,
                spent: 0,
                steps: 0,
            });
        }
        let noise = self.pool.measure.variance * self.run.particles as f64;
        let can_gain = self.options.steps.is_some() || noise >= defaults::least_polished_noise::<D>(self.run.particles);
        let rounds = match self.options.rounds {
            // The material knows of equal masses only.
            _ if self.options.weighted => 0,
            None if !can_gain => 0,
            rounds => rounds.unwrap_or(defaults::POLISH_ROUNDS),
        };
        let spread = mean_distance(&condensed.positions);
        let allowed = self.energy(&condensed) + 2.0 * self.pool.measure.variance * spread;
        let mut best = self.corrected(condensed, allowed)?;
        let (mut spent, mut steps, mut planned) = (best.samples.score_evaluations, 0, defaults::POLISH_STEPS);
        for round in 0..rounds {
            let length = self.options.steps.unwrap_or(planned);
            let candidate = match self.moved(&best, length, (round, steps), journal, observer) {
                // It has left the support of the target, and is no reason to end the run.
                Err(Unfinished {
                    error: SampleError::ScoreNotFinite { step, .. },
                    evaluations,
                }) if self.options.non_finite_scores != NonFiniteScores::Report => {
                    spent += evaluations;
                    steps += step;
                    break;
                }
                moved => moved?,
            };
            spent += candidate.samples.score_evaluations;
            steps += candidate.samples.steps;
            let nearer = self.energy(&candidate) < allowed
                && squared_stein_discrepancy(&candidate) <= squared_stein_discrepancy(&best);
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

    /// The particles that the pool is condensed to, without scores.
    fn condensed(&self) -> Driven<D> {
        let count = self.run.particles;
        let seen = if self.options.weighted {
            self.pool.flattened().condense(count)
        } else {
            self.pool.condense(count)
        };
        Driven {
            positions: seen.iter().map(|x| self.frame.to_reference(x)).collect(),
            samples: Samples {
                positions: seen,
                ..Samples::default()
            },
            scores: Vec::new(),
            drift: 0.0,
            kinetic_energy: 0.0,
        }
    }

    /// The same with scores, and, where that is asked for, the target is nearly normal and the pool does not object, as wide as the pool and with the mean put right.
    fn corrected(&self, condensed: Driven<D>, allowed: f64) -> Result<Driven<D>, SampleError> {
        let corrects = self.entropy_power >= defaults::LEAST_CORRECTED_ENTROPY_POWER && !self.options.weighted;
        if !corrects || self.options.moment_correction == MomentCorrection::Off {
            return self.scored(condensed, MomentCorrection::Off);
        }
        let mut wide = condensed.clone();
        standardise(&mut wide.positions, |axis| self.squared_error_of_variance(axis));
        let corrected = self.scored(wide, self.options.moment_correction)?;
        if self.energy(&corrected) <= allowed {
            return Ok(corrected);
        }
        let mut scored = self.scored(condensed, MomentCorrection::Off)?;
        scored.samples.score_evaluations += corrected.samples.score_evaluations;
        Ok(scored)
    }

    /// Σ c² ((u·z)² − 1)²: how well the pool knows the variance along a unit vector, which is 1 in the coordinates of the frame.
    fn squared_error_of_variance(&self, axis: &[f64; D]) -> f64 {
        let points = self.pool.measure.points.iter().zip(&self.pool.measure.weights);
        let of = |(x, c): (&[f64; D], &f64)| {
            let z = vector::dot(axis, &self.frame.to_reference(x));
            (c * (z * z - 1.0)).powi(2)
        };
        points.map(of).sum()
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
        let mut body = parts
            .of_gas(IsothermalGas::new(1.0)?)
            .map_err(|error| SampleError::in_step(0, error))?;
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
        (number, earlier_steps): (usize, usize),
        journal: &mut Journal,
        observer: &mut dyn Observer,
    ) -> Result<Driven<D>, Unfinished> {
        let options = MpmOptions {
            steps: Some(steps),
            moment_correction: MomentCorrection::Off,
            ..self.options.clone()
        };
        Body {
            options: &options,
            target: self.target,
            frame: &self.frame,
            run: self.run,
            number,
            earlier_steps,
            positions: from.positions.clone(),
            journal,
            observer,
        }
        .run(self.spacing)
    }

    fn energy(&self, body: &Driven<D>) -> f64 {
        self.distance.of(&body.samples.positions)
    }
}

/// E|z − z′| over the particles.
fn mean_distance<const D: usize>(particles: &[[f64; D]]) -> f64 {
    let (half, rest) = particles.split_at(particles.len() / 2);
    let pairs = half.iter().zip(rest.iter().rev());
    pairs.map(|(x, y)| vector::distance(x, y)).sum::<f64>() / half.len().max(1) as f64
}
