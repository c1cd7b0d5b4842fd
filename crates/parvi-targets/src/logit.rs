//! The logit link: a yes has probability σ(t) = 1 / (1 + e^−t).

use crate::Link;
use crate::exponential::{exponential, with_widest_vectors};
use crate::link::PARTICLES_PER_GROUP;
use crate::special::log_one_plus_exp;

/// ℓ(t) = log σ(t) = −log(1 + e^−t), ℓ′ = σ(−t), −ℓ″ = σ(t) σ(−t), for the signed predictor t = ±xᵀβ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Logit;

impl Link for Logit {
    type Response = bool;

    fn log_likelihood(t: f64) -> f64 {
        -log_one_plus_exp(-t)
    }

    fn slope(t: f64) -> f64 {
        1.0 / (1.0 + t.exp())
    }

    /// e^−|t| / (1 + e^−|t|)².
    fn curvature(t: f64) -> f64 {
        let small = (-t.abs()).exp();
        small / ((1.0 + small) * (1.0 + small))
    }

    #[inline(always)]
    fn slope_among_many(t: f64) -> f64 {
        1.0 / (1.0 + exponential(t))
    }

    /// −log(1 + e^−t) = min(t, 0) − log(1 + e^−|t|), and the logarithm is taken once per 128 rows, of the product: as many
    /// factors in (1, 2] are below 2¹²⁸.
    fn add_log_likelihoods(predictors: &[[f64; PARTICLES_PER_GROUP]], sums: &mut [f64; PARTICLES_PER_GROUP]) {
        for block in predictors.chunks(128) {
            let (hinges, products) = block_losses(block);
            for particle in 0..PARTICLES_PER_GROUP {
                sums[particle] -= hinges[particle] + products[particle].ln();
            }
        }
    }
}

/// Per particle, over the block's rows: Σ max(−t, 0) and Π (1 + e^−|t|).
fn block_losses(predictors: &[[f64; PARTICLES_PER_GROUP]]) -> ([f64; PARTICLES_PER_GROUP], [f64; PARTICLES_PER_GROUP]) {
    with_widest_vectors(
        #[inline(always)]
        || {
            let (mut hinges, mut products) = ([0.0; PARTICLES_PER_GROUP], [1.0; PARTICLES_PER_GROUP]);
            for row in predictors {
                for particle in 0..PARTICLES_PER_GROUP {
                    let t = row[particle];
                    hinges[particle] += if t < 0.0 { -t } else { 0.0 };
                    products[particle] *= 1.0 + exponential(-t.abs());
                }
            }
            (hinges, products)
        },
    )
}
