//! What stands in a cell of results.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use crate::page::{Cell, escaped, number};

/// What stands in a cell. A whole number equals the same number.
#[derive(Clone, Debug, Default, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Nothing.
    #[default]
    Empty,
    /// A word, or several.
    Text(String),
    /// A whole number.
    Count(u64),
    /// A number.
    Number(f64),
}

impl Value {
    /// A number, whole or not.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Count(count) => Some(*count as f64),
            _ => None,
        }
    }
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Empty, Self::Empty) => true,
            (Self::Text(text), Self::Text(other)) => text == other,
            (Self::Count(count), Self::Count(other)) => count == other,
            _ => self.number().is_some_and(|number| other.number() == Some(number)),
        }
    }
}

/// As it is, numbers with all their digits.
impl Display for Value {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => Ok(()),
            Self::Text(text) => formatter.write_str(text),
            Self::Count(count) => write!(formatter, "{count}"),
            Self::Number(number) => write!(formatter, "{number}"),
        }
    }
}

impl Cell for Value {
    fn cell(&self) -> String {
        match self {
            Self::Empty => None::<f64>.cell(),
            Self::Number(value) => number(*value),
            Self::Text(text) => escaped(text),
            value => value.to_string(),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        match text {
            "" => Self::Empty,
            text => Self::Text(text.to_owned()),
        }
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, T::into)
    }
}
