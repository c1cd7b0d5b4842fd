//! The synthetic counts of `poisson`.

use rand::rngs::ChaCha8Rng;
use rand::{Rng, RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

use super::making::dimension_within;
use crate::{CountData, MAXIMUM_DIMENSION, TargetError};

/// The rows of `poisson`.
pub const SYNTHETIC_COUNT_ROWS: usize = 40;

/// The coefficients that the counts were made with, the intercept first.
const COEFFICIENTS: [f64; MAXIMUM_DIMENSION] = [0.0, 0.8, -0.6, 0.7, 0.5, 0.3, -0.4, 0.2];

/// The seed of the rows.
const SEED: u64 = 1898;

/// 40 rows of synthetic counts, the nested model with d = `dimension` coefficients.
///
/// Made for a posterior that is not Gaussian: counts are few, most of them 0 or 1; x1 and x2 are standard normal with
/// correlation 0.9; x3 is 1 in one row of five, else 0; x4 to x7 are independent and standard normal. The mean of a count
/// is exp(xᵀβ) with β = (0, 0.8, −0.6, 0.7, 0.5, 0.3, −0.4, 0.2) whichever d is asked for, so that every model sees the
/// same counts. Rows come from ChaCha8 with a fixed seed: per row the seven covariates, then a uniform number of which the
/// count is the quantile.
///
/// # Errors
/// [`TargetError::DimensionNotAllowed`] unless 1 ≤ d ≤ 8.
pub fn synthetic_counts(dimension: usize) -> Result<CountData, TargetError> {
    dimension_within("poisson", dimension, 1..=MAXIMUM_DIMENSION)?;
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    let mut data = CountData::empty("synthetic counts", (1..dimension).map(|index| format!("x{index}")));
    for _ in 0..SYNTHETIC_COUNT_ROWS {
        let mut covariates: [f64; MAXIMUM_DIMENSION - 1] = std::array::from_fn(|index| {
            if index == 2 {
                f64::from(u8::from(rng.random::<f64>() < 0.2))
            } else {
                StandardNormal.sample(&mut rng)
            }
        });
        covariates[1] = 0.9 * covariates[0] + (1.0_f64 - 0.81).sqrt() * covariates[1];
        let slope: f64 = COEFFICIENTS[1..].iter().zip(covariates).map(|(b, x)| b * x).sum();
        let count = poisson_quantile((COEFFICIENTS[0] + slope).exp(), &mut rng);
        data.push(count, &covariates[..dimension - 1]);
    }
    data.non_empty()
}

/// The smallest k with P(count ≤ k) ≥ U for a uniform U; means here are below 100, where e^(−mean) is far from underflow.
fn poisson_quantile(mean: f64, rng: &mut impl Rng) -> u32 {
    let mut rest: f64 = rng.random();
    let mut probability = (-mean).exp();
    let mut count = 0;
    while rest > probability && count < 1000 {
        rest -= probability;
        count += 1;
        probability *= mean / f64::from(count);
    }
    count
}
