//! A number that can be switched off.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::Deserialize;

/// A number, or `off`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "toml::Value")]
pub enum Limit {
    /// No limit.
    Off,
    /// The limit.
    At(f64),
}

impl Limit {
    /// The number, `None` when off.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Off => None,
            Self::At(value) => Some(value),
        }
    }
}

impl FromStr for Limit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "off" {
            return Ok(Self::Off);
        }
        text.parse()
            .map(Self::At)
            .map_err(|_| "must be a number or `off`".to_owned())
    }
}

impl Display for Limit {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Off => write!(formatter, "off"),
            Self::At(value) => write!(formatter, "{value}"),
        }
    }
}

impl TryFrom<toml::Value> for Limit {
    type Error = String;

    fn try_from(value: toml::Value) -> Result<Self, String> {
        match value {
            toml::Value::Float(value) => Ok(Self::At(value)),
            toml::Value::Integer(value) => Ok(Self::At(value as f64)),
            value => value.as_str().unwrap_or_default().parse(),
        }
    }
}
