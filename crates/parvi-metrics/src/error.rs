//! What can be wrong with the input of a metric.

/// The error of every metric: it names the place and the offending value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MetricError {
    /// A cloud without points.
    #[error("the cloud has no points")]
    Empty,
    /// A coordinate that is NaN or infinite.
    #[error("point {index} has the coordinate x{} = {value}; every coordinate must be finite", .axis + 1)]
    NonFinitePoint {
        /// Index of the point.
        index: usize,
        /// Axis of the coordinate, from 0; messages count from 1, as files do.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// Two slices that must have one entry per point but do not.
    #[error("{name} has length {given}, the number of points is {points}")]
    LengthMismatch {
        /// The slice that does not fit.
        name: &'static str,
        /// Number of points.
        points: usize,
        /// Number of entries given.
        given: usize,
    },
    /// A weight that is negative, NaN or infinite.
    #[error("weight {index} is {value}; weights must be finite and at least 0")]
    InvalidWeight {
        /// Index of the weight.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// Weights whose sum or its reciprocal overflows.
    #[error("the weights sum to {total:?}; the sum and its reciprocal must be positive and finite")]
    InvalidTotalWeight {
        /// The sum.
        total: f64,
    },
    /// A statistic over pairs of distinct points, of a cloud with fewer than two points of positive weight.
    #[error("{statistic} needs two points of positive weight")]
    TooFewPoints {
        /// The statistic asked for.
        statistic: &'static str,
    },
    /// A score that is NaN or infinite.
    #[error("the score of point {index} is {value} along x{}; every score must be finite", .axis + 1)]
    NonFiniteScore {
        /// Index of the point.
        index: usize,
        /// Axis of the score, from 0; messages count from 1.
        axis: usize,
        /// The value.
        value: f64,
    },
    /// A parameter outside its range.
    #[error("{name} is {value}; it must be {requirement}")]
    InvalidParameter {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
    /// An entry of a list of parameters (a quantile level, a mode's width) outside its range.
    #[error("{name} {index} is {value}; it must be {requirement}")]
    InvalidEntry {
        /// The list.
        name: &'static str,
        /// Index in the list.
        index: usize,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
    /// A covariance that is not symmetric positive definite.
    #[error("the covariance is not symmetric and positive definite: {reason} {value}")]
    InvalidCovariance {
        /// What was found.
        reason: &'static str,
        /// The offending value.
        value: f64,
    },
    /// A list of modes without entries.
    #[error("the list of modes is empty")]
    NoModes,
    /// Finite input whose result exceeds the range of `f64`.
    #[error("{metric} overflows: the result is {value}")]
    Overflow {
        /// The metric.
        metric: &'static str,
        /// What came out.
        value: f64,
    },
}

/// `value` if it is finite, else the error of an overflow in `metric`.
pub(crate) fn finite(metric: &'static str, value: f64) -> Result<f64, MetricError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(MetricError::Overflow { metric, value })
    }
}

/// `value` if it is as it must be, else the error of a parameter.
pub(crate) fn parameter(
    name: &'static str,
    value: f64,
    is_allowed: bool,
    requirement: &'static str,
) -> Result<f64, MetricError> {
    if is_allowed {
        return Ok(value);
    }
    Err(MetricError::InvalidParameter {
        name,
        value,
        requirement,
    })
}

/// Refuses the first entry of a list that is not as it must be.
pub(crate) fn entries(
    name: &'static str,
    values: &[f64],
    is_allowed: impl Fn(f64) -> bool,
    requirement: &'static str,
) -> Result<(), MetricError> {
    match values.iter().position(|&value| !is_allowed(value)) {
        None => Ok(()),
        Some(index) => Err(MetricError::InvalidEntry {
            name,
            index,
            value: values[index],
            requirement,
        }),
    }
}
