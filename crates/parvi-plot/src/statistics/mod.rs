//! The statistics behind the figures and tables: density estimates, power-law fits, medians, weighted quantiles.

mod bandwidth;
mod kernel_density;
mod kernel_density_grid;
mod moments;
mod power_law;
mod summary;

pub use bandwidth::bandwidth;
pub use kernel_density::{DensityGrid, equidistant, kernel_density};
pub use kernel_density_grid::kernel_density_grid;
pub use moments::SampleMoments;
pub use power_law::{Exponent, PowerLaw, fit_power_law, fit_power_law_of};
pub use summary::{Summary, summarize, weighted_quantile};

/// Why a statistic could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StatisticsError {
    /// There is nothing to compute from.
    #[error("{what}: no values")]
    Empty {
        /// The input that is empty.
        what: &'static str,
    },
    /// Two inputs that belong together differ in length.
    #[error("{what}: expected length {expected}, found {found}")]
    Length {
        /// The input whose length is wrong.
        what: &'static str,
        /// The length that the other input has.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// A value that must be finite is not.
    #[error("{what}[{index}] = {value} is not finite")]
    NotFinite {
        /// The input.
        what: &'static str,
        /// The position in the input.
        index: usize,
        /// The offending value.
        value: f64,
    },
    /// A value that must be positive (or, for a weight, non-negative) is not.
    #[error("{what}[{index}] = {value} is not positive")]
    NotPositive {
        /// The input.
        what: &'static str,
        /// The position in the input.
        index: usize,
        /// The offending value.
        value: f64,
    },
    /// The level of a quantile is not between 0 and 1.
    #[error("{level} is no level of a quantile: it must be from 0 to 1")]
    Level {
        /// The level.
        level: f64,
    },
    /// All weights are zero.
    #[error("the weights sum to zero")]
    NoWeight,
    /// All values are equal, so that neither a bandwidth nor a slope exists.
    #[error("{what}: all values equal {value}")]
    NoSpread {
        /// The input.
        what: &'static str,
        /// The common value.
        value: f64,
    },
    /// The predictors of a fit are linearly dependent, or there are more unknowns than observations.
    #[error("the fit is not determined: the number of observations is {observations}, that of unknowns {unknowns}")]
    Undetermined {
        /// The number of observations.
        observations: usize,
        /// The number of unknowns, the prefactor included.
        unknowns: usize,
    },
    /// The interval on which a density is wanted is empty or not finite.
    #[error("the interval [{low}, {high}] is empty or not finite")]
    Interval {
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
    },
}

/// Checks values and optional weights: at least one value, all finite, weights of the same number, finite, non-negative and
/// not all zero. Returns the sum of the weights (the number of values without weights).
pub(crate) fn check_weighted(
    what: &'static str,
    values: &[f64],
    weights: Option<&[f64]>,
) -> Result<f64, StatisticsError> {
    if values.is_empty() {
        return Err(StatisticsError::Empty { what });
    }
    check_finite(what, values)?;
    let Some(weights) = weights else {
        return Ok(values.len() as f64);
    };
    if weights.len() != values.len() {
        return Err(StatisticsError::Length {
            what: "weights",
            expected: values.len(),
            found: weights.len(),
        });
    }
    check_finite("weights", weights)?;
    if let Some(index) = weights.iter().position(|&weight| weight < 0.0) {
        return Err(StatisticsError::NotPositive {
            what: "weights",
            index,
            value: weights[index],
        });
    }
    let total: f64 = weights.iter().sum();
    if total > 0.0 && total.is_finite() {
        Ok(total)
    } else {
        Err(StatisticsError::NoWeight)
    }
}

/// Checks that every value is finite.
pub(crate) fn check_finite(what: &'static str, values: &[f64]) -> Result<(), StatisticsError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(StatisticsError::NotFinite {
            what,
            index,
            value: values[index],
        }),
        None => Ok(()),
    }
}
