//! What can be wrong with a parameter or with a deformation.

use std::borrow::Cow;

/// A material parameter outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{parameter} must be {expected}, not {value}")]
pub struct ParameterError {
    /// The parameter as documents call it, as in `young_modulus`.
    pub parameter: &'static str,
    /// The value as given.
    pub value: f64,
    /// What is allowed.
    pub expected: Cow<'static, str>,
}

impl ParameterError {
    /// The parameter as documents call it, and its value as given.
    pub fn parameter(&self) -> (&'static str, f64) {
        (self.parameter, self.value)
    }
}

/// A deformation gradient for which a material has no stress.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DeformationError {
    /// An entry of F is NaN or infinite.
    #[error("the deformation gradient is not finite: entry ({row}, {column}) is {value}")]
    NotFinite {
        /// Zero-based row of the first such entry.
        row: usize,
        /// Zero-based column of the first such entry.
        column: usize,
        /// The entry.
        value: f64,
    },
    /// The material is crushed or turned inside out: J = det F is not a positive finite number.
    #[error("the volume ratio det F must be positive and finite, not {volume_ratio}")]
    VolumeRatio {
        /// J = det F.
        volume_ratio: f64,
    },
}

/// The value, if it is in its range.
pub(crate) fn within(
    parameter: &'static str,
    value: f64,
    valid: bool,
    expected: impl Into<Cow<'static, str>>,
) -> Result<f64, ParameterError> {
    valid.then_some(value).ok_or_else(|| ParameterError {
        parameter,
        value,
        expected: expected.into(),
    })
}

/// The value, if it is finite and not negative.
pub(crate) fn not_negative(parameter: &'static str, value: f64) -> Result<f64, ParameterError> {
    within(
        parameter,
        value,
        value >= 0.0 && value.is_finite(),
        "finite and at least 0",
    )
}

/// The value, if it is positive and finite.
pub(crate) fn positive(parameter: &'static str, value: f64) -> Result<f64, ParameterError> {
    within(
        parameter,
        value,
        value > 0.0 && value.is_finite(),
        "positive and finite",
    )
}
