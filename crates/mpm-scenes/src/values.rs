//! Ranges of numbers and lengths of vectors.

use serde::Serialize;

use crate::SceneFault;

/// A number that is positive and finite.
pub(crate) fn positive(field: &str, value: f64) -> Result<f64, SceneFault> {
    within(field, value, value > 0.0 && value.is_finite(), "positive and finite")
}

/// A number that is at least 0 and finite.
pub(crate) fn not_negative(field: &str, value: f64) -> Result<f64, SceneFault> {
    within(field, value, value >= 0.0 && value.is_finite(), "at least 0 and finite")
}

/// The value, if it is valid.
pub(crate) fn within<T: Serialize>(field: &str, value: T, valid: bool, expected: &str) -> Result<T, SceneFault> {
    if valid {
        Ok(value)
    } else {
        Err(SceneFault::value(field, value, expected))
    }
}

/// A number that is finite.
pub(crate) fn finite(field: &str, value: f64) -> Result<f64, SceneFault> {
    within(field, value, value.is_finite(), "finite")
}

/// A number that may be left out, by the rule for one that is there.
pub(crate) fn check(
    value: Option<f64>,
    field: &str,
    rule: fn(&str, f64) -> Result<f64, SceneFault>,
) -> Result<(), SceneFault> {
    value.map_or(Ok(()), |value| rule(field, value).map(drop))
}

/// A list of D finite numbers.
pub(crate) fn vector<const D: usize>(field: &str, list: &[f64]) -> Result<[f64; D], SceneFault> {
    let vector = <[f64; D]>::try_from(list).unwrap_or([f64::NAN; D]);
    let numbers = if D == 1 { "number" } else { "numbers" };
    let valid = list.len() == D && vector.iter().all(|c| c.is_finite());
    within(field, list, valid, &format!("{D} finite {numbers}")).map(|_| vector)
}
