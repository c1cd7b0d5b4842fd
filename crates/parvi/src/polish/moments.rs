//! Moments of condensed particles put right, as far as the pool or the scores know them.

use mpm_core::Particles;
use mpm_materials::IsothermalGas;
use mpm_tensor::vector;
use parvi_body::{FramedScore, Parts, ScoreForce};

use super::Polish;
use crate::driven::Driven;
use crate::moment_correction::{correct_moments, standardise};
use crate::{MomentCorrection, SampleError, defaults};

impl<const D: usize> Polish<'_, D> {
    /// The same with scores, and, where that is asked for, the target is nearly normal and the pool does not object, as wide as the pool and with the mean put right.
    ///
    /// They follow the pool's noise: their distance from the target is that from the pool and that of the pool. Points of least energy distance are narrow, the more so the heavier a tail
    /// is, and wide ones are farther: they are widened as far as a twentieth of that distance pays for. The mean is put right where scores know it better than the pool does: better than for
    /// independent draws, by the root of what these are farther away, since means of smooth functions gain by all of that and those of scores with jumps by less.
    pub(super) fn corrected(&self, condensed: Driven<D>) -> Result<Driven<D>, SampleError> {
        let corrects = self.entropy_power >= defaults::LEAST_CORRECTED_ENTROPY_POWER && !self.options.weighted;
        if !corrects || self.options.moment_correction == MomentCorrection::Off {
            return self.scored(condensed, MomentCorrection::Off, 0.0);
        }
        let (energy, noise) = (self.energy(&condensed), self.distance().noise());
        let distance = (energy - self.distance().own()).max(0.0) + noise;
        let mut wide = condensed.clone();
        standardise(&mut wide.positions, |axis| self.squared_error_of_variance(axis));
        let mut widened = self.energy_in_frame(&wide.positions);
        let (price, affordable) = (widened - energy, defaults::MOMENT_PRICE * distance);
        if price > affordable {
            let share = (affordable / price).sqrt();
            for (z, from) in wide.positions.iter_mut().zip(&condensed.positions) {
                *z = vector::add_scaled(from, share, &vector::subtract(z, from));
            }
            widened = self.energy_in_frame(&wide.positions);
        }
        let spread = mean_distance(&condensed.positions);
        let nearer = (spread / (distance * self.run.particles as f64)).sqrt();
        let corrected = self.scored(
            wide,
            self.options.moment_correction,
            nearer * self.squared_error_of_mean(),
        )?;
        if self.energy(&corrected) <= widened + 2.0 * noise {
            return Ok(corrected);
        }
        let mut scored = self.scored(condensed, MomentCorrection::Off, 0.0)?;
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

    /// Σ c² |z|²: how well the pool knows the mean, which is zero in the coordinates of the frame.
    fn squared_error_of_mean(&self) -> f64 {
        let measure = &self.pool.measure;
        let points = measure.points.iter().zip(&measure.weights).zip(&measure.evaluated);
        let uncertain = points.filter(|(_, evaluated)| **evaluated);
        uncertain
            .map(|((x, c), _)| c * c * vector::norm_squared(&self.frame.to_reference(x)))
            .sum()
    }

    /// Scores and residual of particles that no material has moved, with their moments put right; their mean where scores know it better than to `known`.
    fn scored(
        &self,
        mut condensed: Driven<D>,
        correction: MomentCorrection,
        known: f64,
    ) -> Result<Driven<D>, SampleError> {
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
        correct_moments(correction, known, &mut condensed.positions, score, &mut scores).map_err(failed)?;
        body.particles().positions.clone_from(&condensed.positions);
        let residual = body.residual(&[0.0; D], self.spacing, &scores).map_err(failed)?;
        let (score, samples) = (&body.force().score, &mut condensed.samples);
        (samples.score_evaluations, samples.scores_replaced) = (score.evaluations, score.replaced);
        (samples.residual, samples.spacing) = (Some(residual.ratio()), Some(self.spacing));
        samples.positions = condensed.positions.iter().map(|z| self.frame.to_target(z)).collect();
        condensed.scores = scores;
        Ok(condensed)
    }

    fn energy_in_frame(&self, positions: &[[f64; D]]) -> f64 {
        let seen: Vec<[f64; D]> = positions.iter().map(|z| self.frame.to_target(z)).collect();
        self.distance().of(&seen)
    }
}

/// E|z − z′| over the particles.
fn mean_distance<const D: usize>(particles: &[[f64; D]]) -> f64 {
    let (half, rest) = particles.split_at(particles.len() / 2);
    let pairs = half.iter().zip(rest.iter().rev());
    pairs.map(|(x, y)| vector::distance(x, y)).sum::<f64>() / half.len().max(1) as f64
}
