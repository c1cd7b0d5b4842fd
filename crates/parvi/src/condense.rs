//! Samplers that condense a big sample into M points: Stein thinning and support points.

use mpm_tensor::vector;
use parvi_targets::{CatalogueTarget, Frame, scores_in_calls};

use crate::drive::finite;
use crate::exact::exact_draws;
use crate::start::{check, not_negative, steps};
use crate::stein_thinning::GreedyChoice;
use crate::support_points::ConvexConcave;
use crate::view::Moment;
use crate::{
    Observer, Progress, Run, SampleError, SampleSource, Samples, SteinThinningOptions, SupportPointsOptions, defaults,
};

/// Streams of random numbers; that of independent draws is another.
const POOL_STREAM: u64 = 3;
const START_STREAM: u64 = 4;

impl SteinThinningOptions {
    /// Draw the pool, evaluate its scores and choose M of its draws; one that is chosen twice appears twice.
    ///
    /// The score evaluations are one per draw of the pool and those of the No-U-Turn sampler, where it made the pool.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a target without exact draws, a pool that cannot be thinned, the observer's stop, and those of
    /// [`NutsOptions::sample`](crate::NutsOptions::sample).
    pub fn sample<const D: usize>(
        &self,
        target: &dyn CatalogueTarget<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        let steps = run.particles_of("stein-thinning")?;
        let size = pool_size(self.pool_size, steps)?;
        let pool = match &self.pool {
            SampleSource::Exact => Samples {
                positions: exact_draws("stein-thinning", target, &mut run.generator(POOL_STREAM), size)?,
                ..Samples::default()
            },
            SampleSource::Nuts(options) => {
                let run = Run {
                    particles: size,
                    ..run.clone()
                };
                options.sample(target, frame, &run, observer)?
            }
        };
        let mut scores = vec![[0.0; D]; size];
        scores_in_calls(target, &pool.positions, &mut scores);
        if let Some(index) = scores.iter().position(|score| !vector::is_finite(score)) {
            return Err(SampleError::ScoreNotFinite {
                step: 0,
                position: pool.positions[index].to_vec(),
                score: scores[index].to_vec(),
            });
        }
        let mut choice = GreedyChoice::new(&pool.positions, &scores)?;
        let mut positions = Vec::with_capacity(steps);
        for step in 1..=steps {
            positions.push(pool.positions[choice.next_index()]);
            if observer.after_step(Progress { step, steps }).is_break() {
                return Err(SampleError::Interrupted { step });
            }
        }
        Ok(Samples {
            positions,
            steps,
            score_evaluations: pool.score_evaluations + size as u64,
            divergences: pool.divergences,
            ..Samples::default()
        })
    }
}

impl SupportPointsOptions {
    /// Draw the pool and M further points, and move these to their least energy distance from the pool.
    ///
    /// Distances are taken with every axis in units of the frame, √C_aa, so that no axis drowns another.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a target without exact draws, or the observer's stop.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn CatalogueTarget<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        let count = run.particles_of("support-points")?;
        let size = pool_size(self.pool_size, count)?;
        let steps = steps(self.steps, defaults::SUPPORT_POINTS_STEPS)?;
        let tolerance = not_negative("tolerance", self.tolerance)?;
        let covariance = frame.covariance();
        let scales: [f64; D] = std::array::from_fn(|a| covariance.0[a][a].sqrt());
        let scaled = |stream, count| -> Result<Vec<[f64; D]>, SampleError> {
            let draws = exact_draws("support-points", target, &mut run.generator(stream), count)?;
            let in_scales = |x: [f64; D]| std::array::from_fn(|a| x[a] / scales[a]);
            Ok(draws.into_iter().map(in_scales).collect())
        };
        let procedure = ConvexConcave::new(&scaled(POOL_STREAM, size)?)?;
        let mut positions = scaled(START_STREAM, count)?;
        let in_target = |x: &[f64; D]| std::array::from_fn(|a| x[a] * scales[a]);
        let seen_after = |step: usize| Moment {
            step,
            steps,
            time: step as f64,
            ..Moment::default()
        };
        let mut step = 0;
        seen_after(step).show_points(&positions, &in_target, observer)?;
        while step < steps {
            let displacement = procedure.iterate(&mut positions);
            step += 1;
            seen_after(step).show_points(&positions, &in_target, observer)?;
            if observer.after_step(Progress { step, steps }).is_break() {
                return Err(SampleError::Interrupted { step });
            }
            if displacement <= tolerance {
                break;
            }
        }
        Ok(Samples {
            positions: finite(positions.iter().map(in_target).collect(), step)?,
            steps: step,
            ..Samples::default()
        })
    }
}

/// The size of the pool (or its default), checked to be at least M.
fn pool_size(size: Option<usize>, particles: usize) -> Result<usize, SampleError> {
    let size = size.unwrap_or_else(|| defaults::pool_size(particles));
    let allowed = size >= particles && u32::try_from(size).is_ok();
    check(
        "pool size",
        size as f64,
        allowed,
        "from the number of particles to 2^32 - 1",
    )?;
    Ok(size)
}
