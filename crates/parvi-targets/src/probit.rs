//! The probit link: a yes has probability Φ(t), Φ the standard normal distribution function.

use crate::Link;
use crate::exponential::with_widest_vectors;
use crate::link::PARTICLES_PER_GROUP;
use crate::normal_tail::{Tail, inverse_mills_ratio, log_normal_distribution};

/// Rows whose factors are multiplied before a logarithm is taken.
const ROWS_PER_LOGARITHM: usize = 16;

/// A factor is at least this: smaller ones belong to |t| > 10¹⁴, where the rounding of t²/2 exceeds their logarithm.
const SMALLEST_FACTOR: f64 = 1e-15;

/// Below, λ(t + λ) is summed from its asymptotic series: t + λ cancels.
const SERIES: f64 = -100.0;

/// ℓ(t) = log Φ(t), ℓ′ = λ(t) = φ(t)/Φ(t) (the inverse Mills ratio), −ℓ″ = λ (t + λ), for the signed predictor t = ±xᵀβ.
///
/// Where the logit's loss grows like |t|, the probit's grows like t²/2: its scores are unbounded, λ(t) ≈ −t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probit;

impl Link for Probit {
    type Response = bool;

    fn log_likelihood(t: f64) -> f64 {
        log_normal_distribution(t)
    }

    #[inline(always)]
    fn slope(t: f64) -> f64 {
        inverse_mills_ratio(t)
    }

    /// λ (t + λ) = 1 − 1/t² + 6/t⁴ − 50/t⁶ + O(t⁻⁸) as t → −∞.
    fn curvature(t: f64) -> f64 {
        if t < SERIES {
            let inverse = 1.0 / (t * t);
            1.0 - inverse * (1.0 - inverse * (6.0 - 50.0 * inverse))
        } else {
            let ratio = inverse_mills_ratio(t);
            ratio * (t + ratio)
        }
    }

    fn add_log_likelihoods(predictors: &[[f64; PARTICLES_PER_GROUP]], sums: &mut [f64; PARTICLES_PER_GROUP]) {
        for block in predictors.chunks(ROWS_PER_LOGARITHM) {
            let (squares, products) = block_factors(block);
            for particle in 0..PARTICLES_PER_GROUP {
                sums[particle] += products[particle].ln() - 0.5 * squares[particle];
            }
        }
    }
}

/// Per particle, over the block's rows: Σ min(t, 0)² and the product of Φ(t) e^(min(t, 0)²/2).
fn block_factors(
    predictors: &[[f64; PARTICLES_PER_GROUP]],
) -> ([f64; PARTICLES_PER_GROUP], [f64; PARTICLES_PER_GROUP]) {
    with_widest_vectors(
        #[inline(always)]
        || {
            let (mut squares, mut products) = ([0.0; PARTICLES_PER_GROUP], [1.0; PARTICLES_PER_GROUP]);
            for row in predictors {
                for particle in 0..PARTICLES_PER_GROUP {
                    let t = row[particle];
                    squares[particle] += if t < 0.0 { t * t } else { 0.0 };
                    let factor = Tail::new(t).without_square(t);
                    products[particle] *= if factor < SMALLEST_FACTOR {
                        SMALLEST_FACTOR
                    } else {
                        factor
                    };
                }
            }
            (squares, products)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curvature_is_the_slope_of_the_slope() {
        for i in -3000..=600 {
            let (t, step) = (0.05 * f64::from(i), 1e-3);
            let ahead = Probit::slope(t + step) - Probit::slope(t - step);
            let slope = ahead / (2.0 * step);
            assert!((slope + Probit::curvature(t)).abs() < 1e-6, "{t}");
        }
        // The two forms meet.
        let (above, below) = (Probit::curvature(SERIES), Probit::curvature(SERIES - 1e-12));
        assert!((above - below).abs() < 1e-11, "{above} and {below}");
        assert_eq!(Probit::curvature(-1e12), 1.0);
    }
}
