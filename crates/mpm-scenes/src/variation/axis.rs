//! The cases of a family: all combinations of the choices of its axes.

use serde::Deserialize;
use toml::{Table, Value};

/// Changes of a scene that take each other's place.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Axis {
    /// A dotted key that goes through `values`.
    pub key: Option<String>,
    /// Its values.
    #[serde(default)]
    pub values: Vec<Value>,
    /// What labels call the key; its last name if absent.
    pub label: Option<String>,
    /// Instead of `key`: several keys at once.
    #[serde(default)]
    pub choices: Vec<Choice>,
    /// Whether the largest number of the axis counts and the others do not.
    #[serde(default)]
    pub worst: bool,
}

/// One change of a scene.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// What it is called in labels.
    #[serde(default)]
    pub label: String,
    /// Values by dotted keys.
    #[serde(default)]
    pub set: Table,
    /// Dotted keys that are removed once all is set.
    #[serde(default)]
    pub drop: Vec<String>,
}

/// A combination of choices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Combination {
    /// A name that no other combination has.
    pub name: String,
    /// What tells its series from others: the labels of all axes but those that x goes along or of which the worst counts.
    pub label: String,
    /// Values by dotted keys, later ones over earlier ones.
    pub set: Vec<(String, Value)>,
    /// Dotted keys that are removed once all is set.
    pub drop: Vec<String>,
}

impl Axis {
    /// The choices, each with a label.
    fn labelled(&self) -> Result<Vec<Choice>, String> {
        let choices: Vec<Choice> = match (&self.key, self.choices.is_empty()) {
            (Some(key), true) => self.values.iter().map(|value| self.choice(key, value)).collect(),
            (None, false) if self.values.is_empty() && self.label.is_none() => self.choices.clone(),
            _ => return Err("needs either `key` and `values` or `choices`".to_owned()),
        };
        if choices.is_empty() {
            return Err("`values` is empty".to_owned());
        }
        Ok(choices)
    }

    /// Whether its choices are places on the horizontal axis: they set x itself, or, without a label, a table or array around it.
    fn goes_along(&self, x: &[String]) -> bool {
        let unnamed = self.choices.iter().all(|choice| choice.label.is_empty());
        let keys = self
            .choices
            .iter()
            .flat_map(|choice| choice.set.keys())
            .chain(&self.key);
        let along = |key: &String, x: &String| key == x || (unnamed && holds(key, x));
        keys.into_iter().any(|key| x.iter().any(|x| along(key, x)))
    }

    fn choice(&self, key: &str, value: &Value) -> Choice {
        let label = match value {
            Value::String(text) if self.label.is_none() => text.clone(),
            value => format!("{} = {}", self.label.as_deref().unwrap_or(last_name(key)), text(value)),
        };
        Choice {
            label,
            set: Table::from_iter([(key.to_owned(), value.clone())]),
            drop: Vec::new(),
        }
    }
}

/// All combinations, the last axis fastest; `x` are the dotted keys of the horizontal axis.
///
/// # Errors
/// What is wrong with which axis, in words.
pub fn combinations(axes: &[Axis], x: &[String]) -> Result<Vec<Combination>, String> {
    let mut combinations = vec![Combination::default()];
    for (index, axis) in axes.iter().enumerate() {
        let choices = axis.labelled().map_err(|message| format!("axes.{index} {message}"))?;
        let silent = axis.goes_along(x) || axis.worst;
        let extended = combinations.iter().flat_map(|known| {
            choices.iter().map(|choice| Combination {
                name: joined(&known.name, &named(choice)),
                label: joined(&known.label, if silent { "" } else { &choice.label }),
                set: known.set.iter().cloned().chain(choice.set.clone()).collect(),
                drop: [&known.drop[..], &choice.drop].concat(),
            })
        });
        combinations = extended.collect();
    }
    Ok(combinations)
}

/// Whether a dotted key is `x` or a table or array around it.
fn holds(key: &str, x: &str) -> bool {
    x.strip_prefix(key)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// A choice's label, or all that it sets.
fn named(choice: &Choice) -> String {
    if !choice.label.is_empty() {
        return choice.label.clone();
    }
    let pairs = choice
        .set
        .iter()
        .map(|(key, value)| format!("{} = {}", last_name(key), text(value)));
    pairs.collect::<Vec<_>>().join(", ")
}

fn joined(left: &str, right: &str) -> String {
    let separator = if left.is_empty() || right.is_empty() { "" } else { ", " };
    format!("{left}{separator}{right}")
}

/// The last part of a dotted key that is no index.
fn last_name(key: &str) -> &str {
    let names = key.rsplit('.');
    names
        .into_iter()
        .find(|name| name.parse::<usize>().is_err())
        .unwrap_or(key)
}

fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Float(number) => number.to_string(),
        value => value.to_string(),
    }
}
