//! The verdict of the weights.

use parvi_pool::Pool;

use super::{Certificate, Doubt, MomentEstimate, Outcome, doubt_of_moments, exceeds};
use crate::Samples;
use crate::extent::Extent;

/// Above this shape of the weights' tail nothing is called converged; from 0.7 on no estimate that rests on them is to be relied on.
pub const LARGEST_PARETO_K: f64 = 0.65;

/// The largest standard error of the log evidence of a run that is called converged.
pub const LARGEST_LOG_EVIDENCE_ERROR: f64 = 0.05;

/// The largest variance of the pool then, over that of as many independent draws as there are particles.
pub const LARGEST_POOL_VARIANCE: f64 = 0.2;

/// The largest mass then that fresh points met and no kernel had covered.
pub const LARGEST_MASS_UNCOVERED: f64 = 0.02;

impl Certificate {
    /// The verdict of the pool on particles that were condensed from it.
    pub(crate) fn of_pool<const D: usize>(
        pool: &Pool<D>,
        samples: &Samples<D>,
        drift: f64,
        kinetic_energy: f64,
    ) -> Self {
        let moments = moments(pool, samples);
        let variance = pool.measure.variance * samples.positions.len() as f64;
        let doubt = if exceeds(pool.verdict.pareto_k.unwrap_or(0.0), LARGEST_PARETO_K) {
            Some(Doubt::HeavyTail {
                pareto_k: pool.verdict.pareto_k.unwrap_or(f64::NAN),
            })
        } else if exceeds(pool.log_evidence_error, LARGEST_LOG_EVIDENCE_ERROR) {
            Some(Doubt::Evidence {
                error: pool.log_evidence_error,
            })
        } else if exceeds(variance, LARGEST_POOL_VARIANCE) {
            Some(Doubt::Noise { variance })
        } else if exceeds(pool.verdict.mass_uncovered, LARGEST_MASS_UNCOVERED) {
            Some(Doubt::Uncovered {
                mass: pool.verdict.mass_uncovered,
            })
        } else {
            // Two standard errors of the pool.
            doubt_of_moments(&moments, 2.0 / (samples.positions.len() as f64).sqrt())
        };
        Self {
            outcome: doubt.map_or(Outcome::Converged, Outcome::Stalled),
            moments,
            degree: 0,
            drift,
            kinetic_energy,
        }
    }
}

/// The particles' moments beside those of the pool.
fn moments<const D: usize>(pool: &Pool<D>, samples: &Samples<D>) -> Vec<MomentEstimate> {
    let own = Extent::of(&samples.positions);
    let rate = (samples.positions.len() as f64).sqrt();
    let of_axis = |a: usize| {
        let mean = pool.expectation(|x| x[a]);
        let square = pool.expectation(|x| (x[a] - mean.value).powi(2));
        let deviation = square.value.max(0.0).sqrt();
        let deviation_error = square.standard_error / (2.0 * deviation);
        MomentEstimate {
            mean: own.mean[a],
            mean_estimate: mean.value,
            mean_standard_error: (own.mean[a] - mean.value).hypot(mean.standard_error),
            mean_unexplained: rate * mean.standard_error / own.deviation[a],
            standard_deviation: own.deviation[a],
            standard_deviation_estimate: deviation,
            standard_deviation_standard_error: (own.deviation[a] - deviation).hypot(deviation_error),
            standard_deviation_unexplained: rate * deviation_error / own.deviation[a],
        }
    };
    (0..D).map(of_axis).collect()
}
