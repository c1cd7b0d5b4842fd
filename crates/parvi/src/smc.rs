//! Tempered sequential Monte Carlo, waste-free: populations on their way from a wide law to the target. A yardstick that users know, without the material.
//!
//! H.-D. Dau, N. Chopin, *Waste-free sequential Monte Carlo*, J. R. Stat. Soc. B 84 (2022): Algorithm 1, with temperatures chosen on the way. Ordered resampling: M. Gerber, N. Chopin,
//! N. Whiteley, *Negative association, ordering and convergence of resampling methods*, Ann. Stat. 47 (2019).

mod curve;
mod population;

use parvi_pool::PoolError;
use parvi_targets::{Frame, Target};
use rand::RngExt;

use crate::drive::finite;
use crate::method::with_defaults;
use crate::start::{Stream, check};
use crate::task::{Task, sampler};
use crate::{Progress, SampleError, Samples};
use population::{Population, State};

/// Temperatures, at most.
const TEMPERATURES: usize = 2000;

with_defaults! {
    /// Options of tempered sequential Monte Carlo.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct SmcOptions {
        /// States of all populations together, at least the number of particles; `None`: four times that, and at least 1,024.
        pub pool_size: Option<usize> = None,
        /// Independent populations R ≥ 2, from which the error of the evidence comes.
        pub populations: usize = 8,
        /// States of a chain P ≥ 2: a population resamples one of P states, and keeps all that the chains from there visit.
        pub chain_length: usize = 16,
    }
}

sampler! {
    /// M particles of equal weight from R populations on the path q₀^{1−β} p^β, β from 0 to 1, in coordinates z of the frame; q₀ = N(m, (3 s)² I) for the start law N(m, s² I).
    ///
    /// A population of N states at one temperature:
    ///
    /// 1. Δβ is the step at which the increments w_n = (p(z_n)/q₀(z_n))^{Δβ} have an effective size of N/2; log Z grows by ln mean w_n.
    /// 2. N/P ancestors are resampled by w, systematically along a Hilbert curve.
    /// 3. Each begins a chain of P states by Metropolis-adjusted Langevin moves with the population's covariance; all N states go on.
    ///
    /// Z is the mean of the populations' Z_r, in the target's own coordinates; the standard error of log Z is sd(Z_r) / (Z √R). It rests on R − 1 degrees of freedom and knows nothing of a part of the
    /// target that no population has found. Particles are resampled from the last states of all populations, those of population r with weight Z_r.
    ///
    /// A log density that is NaN or +∞ counts as −∞, a score that is not finite as 0. One evaluation of each is counted per state visited.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a target that is nowhere finite or that no 2,000 temperatures reach, or the observer's stop.
    SmcOptions => Self::run
}

impl SmcOptions {
    fn run<const D: usize>(&self, task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
        let count = task.run.particles_of("smc")?;
        let ancestors = self.ancestors(count)?;
        task.needs_log_density("method `smc`")?;
        let (target, frame, run, observer) = task.parts();
        let start = run.checked_start()?;
        let begin = |number| {
            let standard = run.standard_positions(ancestors * self.chain_length, number)?;
            let generator = run.generator(Stream::Places.of_body(number));
            let population = Population::new(target, frame, &start, &standard, generator);
            Ok(population)
        };
        let mut populations = (0..self.populations)
            .map(begin)
            .collect::<Result<Vec<Population<D>>, SampleError>>()?;
        let mut step = 0;
        while populations.iter().any(Population::is_on_its_way) {
            step += 1;
            if step > TEMPERATURES {
                return Err(SampleError::TooFar {
                    temperatures: TEMPERATURES,
                });
            }
            mpm_parallel::each(populations.iter_mut(), &|population| population.advance(ancestors));
            let steps = step + usize::from(populations.iter().any(Population::is_on_its_way));
            if observer.after_step(Progress { step, steps }).is_break() {
                return Err(SampleError::Interrupted { step });
            }
        }
        let (log_mean, relative_error, shares) =
            evidence(&populations).ok_or_else(|| nowhere_finite(&populations, target, frame))?;
        let states = populations.iter().flat_map(Population::states);
        let points: Vec<[f64; D]> = states.map(|state: &State<D>| state.z).collect();
        let weight_of = |population: usize| shares[population] / populations[population].states().len() as f64;
        let weights: Vec<f64> = (0..populations.len())
            .flat_map(|population| vec![weight_of(population); populations[population].states().len()])
            .collect();
        let offset = run.generator(Stream::Survey.of_body(0)).random();
        let chosen = curve::resampled(&points, &weights, count, offset);
        let evaluations = populations.iter().map(|population| population.evaluations).sum();
        Ok(Samples {
            positions: finite(chosen.iter().map(|&i| frame.to_target(&points[i])).collect(), step)?,
            steps: step,
            score_evaluations: evaluations,
            density_evaluations: evaluations,
            log_evidence: Some(log_mean + frame.log_determinant()),
            log_evidence_error: Some(relative_error),
            ..Samples::default()
        })
    }

    /// Ancestors of one population.
    fn ancestors(&self, count: usize) -> Result<usize, SampleError> {
        let size = self.pool_size.unwrap_or_else(|| count.saturating_mul(4).max(1024));
        let fits = size >= count && u32::try_from(size).is_ok();
        check("pool size", size as f64, fits, "at least the particles, below 2^32")?;
        let (populations, length) = (self.populations, self.chain_length);
        let allowed = |value: usize| (2..=size).contains(&value);
        check(
            "populations",
            populations as f64,
            allowed(populations),
            "from 2 to the pool size",
        )?;
        check(
            "chain length",
            length as f64,
            allowed(length),
            "from 2 to the pool size",
        )?;
        Ok(size.div_ceil(populations * length).max(2))
    }
}

/// ln Z̄ of the mean Z̄ of the populations' evidences in frame coordinates, the standard error of Z̄ over Z̄, and the shares Z_r / (R Z̄).
/// `None` where no population has any.
fn evidence<const D: usize>(populations: &[Population<D>]) -> Option<(f64, f64, Vec<f64>)> {
    let logs = populations.iter().map(|population| population.log_evidence);
    let largest = logs.clone().fold(f64::NEG_INFINITY, f64::max);
    if largest == f64::NEG_INFINITY {
        return None;
    }
    let count = populations.len() as f64;
    let values: Vec<f64> = logs.map(|log| (log - largest).exp()).collect();
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let shares = values.iter().map(|value| value / (count * mean)).collect();
    Some((largest + mean.ln(), (variance / count).sqrt() / mean, shares))
}

/// What the target is at the first states, which are the last ones where no density is finite.
fn nowhere_finite<const D: usize>(
    populations: &[Population<D>],
    target: &dyn Target<D>,
    frame: &Frame<D>,
) -> SampleError {
    let states = populations.iter().flat_map(Population::states);
    let values = states.map(|state| target.log_density(&frame.to_target(&state.z)));
    let (mut points, mut undefined) = (0, 0);
    for value in values {
        points += 1;
        undefined += u64::from(value != f64::NEG_INFINITY);
    }
    SampleError::Pool(PoolError::NowhereFinite {
        points,
        finite: 0,
        undefined,
        beyond: 0,
        scores: 0,
    })
}
