//! A number that can be switched off.

use std::str::FromStr;

use serde::Deserialize;

use parvi_plot::results::Value;

/// A number, or `off`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "toml::Value")]
pub struct Limit(Option<f64>);

impl Limit {
    /// The number, `None` when off.
    pub fn value(self) -> Option<f64> {
        self.0
    }
}

impl FromStr for Limit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = Some(text).filter(|text| *text != "off").map(str::parse).transpose();
        number.map(Self).map_err(|_| "must be a number or `off`".to_owned())
    }
}

impl From<Limit> for Value {
    fn from(limit: Limit) -> Self {
        limit.value().map_or("off".into(), Self::Number)
    }
}

impl TryFrom<toml::Value> for Limit {
    type Error = String;

    fn try_from(value: toml::Value) -> Result<Self, String> {
        match value {
            toml::Value::Float(value) => Ok(Self(Some(value))),
            toml::Value::Integer(value) => Ok(Self(Some(value as f64))),
            value => value.as_str().unwrap_or_default().parse(),
        }
    }
}
