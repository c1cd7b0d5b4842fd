//! What is wrong with one option.

use std::fmt::Display;

use parvi_targets::TargetError;
use thiserror::Error;

/// An option that is out of place or out of range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{name}: {reason}")]
pub struct OptionError {
    /// The option's name, as on the command line but without dashes in front.
    pub name: String,
    /// What is wrong, with the value.
    pub reason: String,
}

impl OptionError {
    /// What is wrong with an option.
    pub fn new(name: &str, reason: impl Into<String>) -> Self {
        Self {
            name: name.to_owned(),
            reason: reason.into(),
        }
    }

    /// An option that a method does not have; `options` are those that it has, with spaces between.
    pub fn foreign(name: &str, value: &str, method: &str, options: &str) -> Self {
        let own: Vec<String> = options.split_whitespace().map(|option| format!("--{option}")).collect();
        let own = match own.is_empty() {
            true => "no options of its own".to_owned(),
            false => own.join(", "),
        };
        Self::new(name, format!("{value} does not fit method `{method}`, which has {own}"))
    }

    /// A value that does not fit a method, or an option that is none of methods.
    pub fn misfit(name: &str, value: &str, method: &str) -> Self {
        Self::new(name, format!("{value} does not fit method `{method}`"))
    }

    /// A value outside of its range.
    pub fn out_of_range(name: &str, value: impl Display, expected: &str) -> Self {
        Self::new(name, format!("{value} must be {expected}"))
    }

    /// The flag that asks for a target which there is not; `None` where no flag does, but its data.
    pub fn of_target(error: &TargetError) -> Option<Self> {
        let name = match error {
            TargetError::OutOfRange { field, value, allowed } if PARAMETERS.iter().any(|(word, _)| word == field) => {
                return Some(Self::out_of_range(parameter_in(field), value, allowed));
            }
            TargetError::OutOfRange { field, .. } | TargetError::NotFinite { field, .. } => parameter_in(field),
            TargetError::ParameterNotAllowed { parameter, .. } | TargetError::ParameterMissing { parameter, .. } => {
                parameter
            }
            TargetError::DimensionMissing { .. } | TargetError::DimensionNotAllowed { .. } => "dim",
            TargetError::UnknownTarget { .. } => "target",
            TargetError::ProgramFailed { .. } => "program",
            _ => return None,
        };
        Some(Self::new(name, error.to_string()))
    }
}

/// Words for the parameters of targets, and their flags.
const PARAMETERS: [(&str, &str); 7] = [
    ("correlation", "correlation"),
    ("curvature", "curvature"),
    ("width", "width"),
    ("spread", "spread"),
    ("radius", "radius"),
    ("degrees of freedom", "degrees-of-freedom"),
    ("prior standard deviation", "prior-sd"),
];

/// The flag of the parameter that a field is made of; that of the target if it is made of none.
fn parameter_in(field: &str) -> &'static str {
    let known = PARAMETERS.iter().find(|(word, _)| field.contains(word));
    known.map_or("target", |(_, flag)| flag)
}
