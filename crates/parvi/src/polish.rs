//! Particles evened out by the material, as far as that brings them nearer to what the pool knows.

mod moments;

use std::cell::OnceCell;

use parvi_pool::{EnergyDistance, Pool};
use parvi_targets::{Frame, Target};

use crate::checkpoint::Journal;
use crate::driven::Driven;
use crate::mpm_body::{Body, Unfinished};
use crate::start::positive;
use crate::stein_discrepancy::squared_stein_discrepancy;
use crate::strays::{BEYOND, bring_back, has_edges};
use crate::{MomentCorrection, MpmOptions, NonFiniteScores, Observer, Run, SampleError, defaults};

/// Evens out particles that were condensed from a pool.
pub(crate) struct Polish<'a, const D: usize> {
    options: &'a MpmOptions,
    target: &'a dyn Target<D>,
    pool: &'a Pool<D>,
    run: &'a Run,
    /// The coordinates in which the body moves and energy distances are taken: those in which the pool has mean zero and covariance I.
    frame: Frame<D>,
    distance: OnceCell<EnergyDistance<D>>,
    spacing: f64,
    entropy_power: f64,
}

/// The best particles, and what all candidates took.
pub(crate) struct Polished<const D: usize> {
    pub best: Driven<D>,
    /// Evaluations of the score and of the log density.
    pub spent: u64,
    pub densities: u64,
    pub steps: usize,
}

impl<const D: usize> Polished<D> {
    /// Particles that have not moved, and how often log p was evaluated for them.
    pub fn still(best: Driven<D>, densities: u64) -> Self {
        Self {
            best,
            spent: 0,
            densities,
            steps: 0,
        }
    }
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
            distance: OnceCell::new(),
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
    /// Condensed particles follow the pool's noise, an energy distance n from the target: they are nearer to it than to the target by n, and others, which do not follow it, are farther
    /// from it than from the target by n. So a candidate is taken if its energy distance to the pool exceeds theirs by less than 2 n, and if its kernel Stein discrepancy is no larger;
    /// one that ends where a score is not finite is not.
    pub fn run(&self, journal: &mut Journal, observer: &mut dyn Observer) -> Result<Polished<D>, SampleError> {
        let (condensed, mut densities) = self.condensed();
        if self.options.rounds == Some(0) {
            return Ok(Polished::still(condensed, densities));
        }
        let variance = self.pool.measure.variance * self.run.particles as f64;
        let is_noisy = variance >= defaults::LARGEST_POOL_NOISE;
        let can_gain = self.options.steps.is_some() || is_noisy || self.run.particles > defaults::LARGEST_POOL;
        let rounds = match self.options.rounds {
            // The material knows of equal masses only.
            _ if self.options.weighted => 0,
            None if !can_gain => 0,
            rounds => rounds.unwrap_or(defaults::POLISH_ROUNDS),
        };
        let mut best = self.corrected(condensed)?;
        let (mut spent, mut steps, mut planned) = (best.samples.score_evaluations, 0, defaults::POLISH_STEPS);
        let mut allowed = None;
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
            let allowed = *allowed.get_or_insert_with(|| self.energy(&best) + 2.0 * self.distance().noise());
            let nearer = self.energy(&candidate) < allowed
                && squared_stein_discrepancy(&candidate) <= squared_stein_discrepancy(&best);
            if !nearer {
                break;
            }
            best = candidate;
            if !is_noisy {
                break;
            }
            planned *= 2;
        }
        // Corrections, the material and the rounding of coordinates know of no edges.
        if has_edges(self.pool) {
            densities += bring_back(self.target, self.pool, 0.0, &mut best.samples.positions);
        }
        Ok(Polished {
            best,
            spent,
            densities,
            steps,
        })
    }

    /// The particles that the pool is condensed to, without scores, and how often log p was evaluated for them.
    fn condensed(&self) -> (Driven<D>, u64) {
        let count = self.run.particles;
        // Weighted particles stand for light parts, too.
        let (mut seen, beyond) = if self.options.weighted {
            (self.pool.flattened().condense(count), 0.0)
        } else {
            (self.pool.condense(count), BEYOND)
        };
        let densities = bring_back(self.target, self.pool, beyond, &mut seen);
        let in_frame = seen.iter().map(|x| self.frame.to_reference(x)).collect();
        (Driven::at_rest(in_frame, seen), densities)
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

    /// Made when it is first asked for.
    fn distance(&self) -> &EnergyDistance<D> {
        let new = || EnergyDistance::new(&self.pool.measure, self.frame);
        self.distance.get_or_init(new)
    }

    fn energy(&self, body: &Driven<D>) -> f64 {
        self.distance().of(&body.samples.positions)
    }

    /// The energy distance of particles from the target, which is that from the pool and that of the pool for those that follow it and no more for others, over that of as many independent draws.
    pub fn relative_distance(&self, particles: &[[f64; D]]) -> f64 {
        let (distance, own) = (self.distance(), self.distance().own());
        ((distance.of(particles) - own).max(0.0) + distance.noise()) * particles.len() as f64 / own
    }
}
