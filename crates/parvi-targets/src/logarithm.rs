//! The logarithmic link: counts with the mean e^t.

use crate::Link;
use crate::exponential::{exponential, with_widest_vectors};
use crate::link::PARTICLES_PER_GROUP;

/// Beyond t = 100, e^t is continued by its tangent. Means of e^100 = 3e43 have no probability for any count that fits a
/// `u32`, but an exponential that overflows would leave a particle that strays there with nothing to come back by.
const LARGEST_PREDICTOR: f64 = 100.0;

/// ℓ(t) = −e^t, ℓ′ = −e^t, −ℓ″ = e^t, the part of the Poisson distribution's log likelihood y t − e^t − log y! that is not
/// linear in the predictor t = xᵀβ. For t > 100 the tangent continues ℓ, so that ℓ′ stays −e^100 and ℓ″ is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Logarithm;

impl Link for Logarithm {
    type Response = u32;

    fn log_likelihood(t: f64) -> f64 {
        let held = held(t);
        -held.exp() * (1.0 + (t - held))
    }

    fn slope(t: f64) -> f64 {
        -held(t).exp()
    }

    fn curvature(t: f64) -> f64 {
        if t > LARGEST_PREDICTOR { 0.0 } else { t.exp() }
    }

    #[inline(always)]
    fn slope_among_many(t: f64) -> f64 {
        -exponential(held(t))
    }

    fn add_log_likelihoods(predictors: &[[f64; PARTICLES_PER_GROUP]], sums: &mut [f64; PARTICLES_PER_GROUP]) {
        with_widest_vectors(
            #[inline(always)]
            || {
                // A partial sum per block.
                let mut means = [0.0; PARTICLES_PER_GROUP];
                for row in predictors {
                    for particle in 0..PARTICLES_PER_GROUP {
                        let held = held(row[particle]);
                        means[particle] += exponential(held) * (1.0 + (row[particle] - held));
                    }
                }
                for particle in 0..PARTICLES_PER_GROUP {
                    sums[particle] -= means[particle];
                }
            },
        );
    }
}

/// min(t, 100); NaN stays NaN.
#[inline(always)]
fn held(t: f64) -> f64 {
    if t > LARGEST_PREDICTOR { LARGEST_PREDICTOR } else { t }
}
