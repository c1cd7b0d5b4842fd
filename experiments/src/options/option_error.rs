//! What is wrong with one option.

use std::fmt::{self, Display, Formatter};

/// An option that is out of place or out of range.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionError {
    /// The option's name, as on the command line but without dashes in front.
    pub name: String,
    /// What is wrong, with the value.
    pub reason: String,
}

impl OptionError {
    /// An option that a method does not have.
    pub fn misfit(name: &str, value: &str, method: &str) -> Self {
        Self {
            name: name.to_owned(),
            reason: format!("{value} does not fit method `{method}`"),
        }
    }

    /// A value outside of its range.
    pub fn out_of_range(name: &str, value: impl Display, expected: &str) -> Self {
        Self {
            name: name.to_owned(),
            reason: format!("{value} must be {expected}"),
        }
    }
}

impl Display for OptionError {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.name, self.reason)
    }
}

impl std::error::Error for OptionError {}
