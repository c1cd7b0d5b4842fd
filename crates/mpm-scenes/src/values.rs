//! Ranges of numbers and lengths of vectors.

use crate::SceneFault;

/// A number that is positive and finite.
pub(crate) fn positive(field: &str, value: f64) -> Result<f64, SceneFault> {
    within(field, value, value > 0.0 && value.is_finite(), "positive and finite")
}

/// A number that is at least 0 and finite.
pub(crate) fn not_negative(field: &str, value: f64) -> Result<f64, SceneFault> {
    within(field, value, value >= 0.0 && value.is_finite(), "at least 0 and finite")
}

/// The value, if it is in its range.
pub(crate) fn within(field: &str, value: f64, valid: bool, expected: &str) -> Result<f64, SceneFault> {
    if valid {
        Ok(value)
    } else {
        Err(SceneFault::value(field, value, expected))
    }
}

/// A list of D finite numbers.
pub(crate) fn vector<const D: usize>(field: &str, list: &[f64]) -> Result<[f64; D], SceneFault> {
    match <[f64; D]>::try_from(list) {
        Ok(vector) if vector.iter().all(|c| c.is_finite()) => Ok(vector),
        _ => {
            let numbers = if D == 1 { "number" } else { "numbers" };
            Err(SceneFault::value(field, list, format!("{D} finite {numbers}")))
        }
    }
}
