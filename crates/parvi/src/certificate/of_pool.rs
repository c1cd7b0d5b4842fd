//! The verdict of the weights.

use mpm_tensor::power_of_two;
use parvi_pool::{Estimate, Objection, Pool};

use super::{Certificate, Doubt, EstimatedMoment, MomentEstimate, Outcome, doubt_of_moments};
use crate::Samples;
use crate::extent::Extent;

/// Share of the pool's effective size that carries the second moment of a coordinate, at least.
const LEAST_CARRIED: f64 = 1.0 / 16.0;

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
        let (moments, carriers): (Vec<_>, Vec<_>) = moments(pool, samples, rate).into_iter().unzip();
        let doubt_of_pool = || match pool.objection(particles) {
            Some(Objection::HeavyTail(pareto_k)) => Some(Doubt::HeavyTail { pareto_k }),
            Some(Objection::Evidence(error)) => Some(Doubt::Evidence { error }),
            Some(Objection::Noise(variance)) => Some(Doubt::Noise { variance }),
            Some(Objection::Uncovered(mass)) => Some(Doubt::Uncovered { mass }),
            Some(Objection::Undefined(share)) => Some(Doubt::Undefined { share }),
            Some(Objection::Inconsistent(ratio)) => Some(Doubt::Inconsistent { ratio }),
            Some(Objection::Searching(quiet)) => Some(Doubt::Searching { quiet }),
            // Two standard errors of the pool.
            None => doubt_of_moments(&moments, 2.0 / rate).or_else(|| hanging(&carriers, pool.effective_size())),
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

/// The axis whose second moment the least share of the pool carries, if that is too little. Of independent draws it is one over the kurtosis, 1/3 of normal ones: where it is less than 1/16 there may be a longer tail than was met, of which no standard error says anything.
fn hanging(carriers: &[f64], size: f64) -> Option<Doubt> {
    let shares = (1..).zip(carriers.iter().map(|carriers| carriers / size));
    let (axis, share) = shares.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
    (share < LEAST_CARRIED).then_some(Doubt::Hangs { axis, share })
}

/// The particles' moments beside those of the pool, what these leave unexplained times `rate`; with the carriers of each second moment.
fn moments<const D: usize>(pool: &Pool<D>, samples: &Samples<D>, rate: f64) -> Vec<(MomentEstimate, f64)> {
    let own = Extent::of_weighted(&samples.positions, samples.weights.as_deref());
    let of_axis = |a: usize| {
        // In units of a power of two, which rounds nothing: squares of squares of large coordinates overflow.
        let unit = power_of_two(own.deviation[a]);
        let in_units = |of: Estimate, unit: f64| Estimate {
            value: of.value * unit,
            standard_error: of.standard_error * unit,
            ..of
        };
        let mean = in_units(pool.expectation(|x| x[a] / unit), unit);
        let square = in_units(pool.expectation(|x| ((x[a] - mean.value) / unit).powi(2)), unit * unit);
        let deviation = square.value.max(0.0).sqrt();
        let deviation_error = square.standard_error / (2.0 * deviation);
        let moment = MomentEstimate {
            mean: EstimatedMoment {
                value: own.mean[a],
                estimate: mean.value,
                standard_error: (own.mean[a] - mean.value).hypot(mean.standard_error),
                unexplained: rate * mean.standard_error / deviation,
            },
            standard_deviation: EstimatedMoment {
                value: own.deviation[a],
                estimate: deviation,
                standard_error: (own.deviation[a] - deviation).hypot(deviation_error),
                unexplained: rate * deviation_error / deviation,
            },
        };
        (moment, square.carriers)
    };
    (0..D).map(of_axis).collect()
}
