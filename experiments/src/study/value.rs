//! What stands in a cell of results.

use serde::{Serialize, Serializer};

use super::status::Status;
use crate::plots::page::{Cell, number};

/// The columns that hold words; all others hold numbers.
const WORDS: &str = "case status ending reason note message outcome target method series sweep family label quantity scene against variant \
     material schedule score volumes basis start_draws transfer shifts rotation settling_shifts moment_correction guards escaped turned";

/// The columns that hold a [`Status`].
pub const ENDINGS: [&str; 2] = ["status", "ending"];

/// What stands in a cell.
#[derive(Clone, Debug, Default, PartialEq)]
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
    /// What a file holds in a column.
    ///
    /// # Errors
    /// A text that does not belong there, in words.
    pub fn read(column: &str, text: &str) -> Result<Self, String> {
        let is_ending = ENDINGS.contains(&column);
        if is_ending && Status::of(text).is_none() {
            return Err(format!("`{text}` is no `{column}`"));
        }
        match text {
            "" => Ok(Self::Empty),
            text if WORDS.split(' ').any(|name| name == column) => Ok(Self::Text(text.to_owned())),
            text => {
                let number = || text.parse().map(Self::Number);
                let value = text.parse().map(Self::Count).or_else(|_| number());
                value.map_err(|_| format!("`{text}` in the column `{column}` is no number"))
            }
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Empty => serializer.serialize_none(),
            Self::Text(text) => serializer.serialize_str(text),
            Self::Count(count) => serializer.serialize_u64(*count),
            Self::Number(number) => serializer.serialize_f64(*number),
        }
    }
}

impl Cell for Value {
    fn cell(&self) -> String {
        match self {
            Self::Empty => None::<f64>.cell(),
            Self::Text(text) => text.clone(),
            Self::Count(count) => count.to_string(),
            Self::Number(value) => number(*value),
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

impl From<Status> for Value {
    fn from(status: Status) -> Self {
        status.as_str().into()
    }
}

/// A text for one cell: without line breaks, so that a file whose last line has no end was cut off.
pub fn single_line(text: impl ToString) -> String {
    text.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
