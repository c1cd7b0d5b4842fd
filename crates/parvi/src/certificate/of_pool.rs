//! The verdict of the weights.

use parvi_pool::{Marginal, Objection, Pool};

use super::{Certificate, Doubt, EstimatedMoment, MomentEstimate, Outcome, doubt_of_moments};
use crate::Samples;
use crate::extent::Extent;

impl Certificate {
    /// The verdict of the pool on particles that were condensed from it, or on its points where it was made for so many particles, unless there is a doubt without it; with drift and kinetic
    /// energy of the particles.
    pub(crate) fn of_pool<const D: usize>(
        pool: &Pool<D>,
        doubt: Option<Doubt>,
        (samples, particles): (&Samples<D>, usize),
        (drift, kinetic_energy): (f64, f64),
    ) -> Self {
        let rate = (particles as f64).sqrt();
        let marginals = pool.marginals();
        let moments = moments(&marginals, samples, rate);
        let doubt_of_pool = || match pool.objection_given(particles, &marginals) {
            Some(Objection::HeavyTail(pareto_k)) => Some(Doubt::HeavyTail { pareto_k }),
            Some(Objection::Evidence(error)) => Some(Doubt::Evidence { error }),
            Some(Objection::Noise(variance)) => Some(Doubt::Noise { variance }),
            Some(Objection::Uncovered(mass)) => Some(Doubt::Uncovered { mass }),
            Some(Objection::Undefined(share)) => Some(Doubt::Undefined { share }),
            Some(Objection::Inconsistent(ratio)) => Some(Doubt::Inconsistent { ratio }),
            Some(Objection::Searching(quiet)) => Some(Doubt::Searching { quiet }),
            Some(Objection::Hanging { axis, share }) => Some(Doubt::Hangs { axis, share }),
            // Two standard errors of the pool.
            None => doubt_of_moments(&moments, 2.0 / rate),
        };
        Self {
            outcome: doubt
                .or_else(doubt_of_pool)
                .map_or(Outcome::Converged, Outcome::Stalled),
            moments,
            degree: 0,
            drift,
            kinetic_energy,
        }
    }
}

/// The particles' moments beside those of the pool, what these leave unexplained times `rate`.
fn moments<const D: usize>(marginals: &[Marginal; D], samples: &Samples<D>, rate: f64) -> Vec<MomentEstimate> {
    let own = Extent::of_weighted(&samples.positions, samples.weights.as_deref());
    let of_axis = |(a, marginal): (usize, &Marginal)| {
        let (deviation, deviation_error) = marginal.deviation();
        let moment = |value: f64, estimate: f64, error: f64| EstimatedMoment {
            value,
            estimate,
            standard_error: (value - estimate).hypot(error),
            unexplained: rate * error / deviation,
        };
        MomentEstimate {
            mean: moment(own.mean[a], marginal.mean.value, marginal.mean.standard_error),
            standard_deviation: moment(own.deviation[a], deviation, deviation_error),
        }
    };
    marginals.iter().enumerate().map(of_axis).collect()
}
