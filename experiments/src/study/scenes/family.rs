//! A family of runs of one scene.

use mpm_scenes::reading::{Reading, ReadingError};
use mpm_scenes::variation::Axis;
use serde::Deserializer;
use toml::Table;

use crate::plots::judgement::{Asked, Judgement, without_run};
use crate::study::prelude::*;

/// Runs of one scene with changes, of each of which one number is read.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Family {
    /// Its name, also of its figure.
    pub name: String,
    /// Heads its part of the report.
    pub title: String,
    /// What the report says of it.
    pub note: Option<String>,
    /// A family before this one whose scene, changes, axes and x are this one's where it has none; equal runs are made once.
    pub like: Option<String>,
    /// The scene's file, relative to the configuration's.
    pub scene: Option<String>,
    /// Changes of all its runs: values by dotted keys.
    #[serde(default)]
    pub set: Table,
    /// What differs between the runs.
    #[serde(default)]
    pub axes: Vec<Axis>,
    /// The dotted key of a number of the scene: the horizontal axis. Of several the first that is there.
    #[serde(default, deserialize_with = "one_or_several")]
    pub x: Vec<String>,
    /// The label of that axis, with its unit.
    pub x_label: Option<String>,
    /// The label of the vertical axis, with its unit.
    pub y_label: String,
    /// The number.
    pub read: Reading,
    /// What is asked of the numbers.
    #[serde(default)]
    pub judgements: Vec<Judgement>,
    /// The labels, or parts of them, of the series that are judged; empty: all.
    #[serde(default)]
    pub judged: Vec<String>,
    /// Columns of the runs' series that are drawn over time, a panel each.
    #[serde(default)]
    pub history: Vec<HistoryPanel>,
    /// The x of the runs whose history is drawn; empty: all.
    #[serde(default)]
    pub drawn: Vec<f64>,
}

/// A dotted key, or a list of them.
fn one_or_several<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Keys {
        One(String),
        Several(Vec<String>),
    }

    Ok(match Keys::deserialize(deserializer)? {
        Keys::One(key) => vec![key],
        Keys::Several(keys) => keys,
    })
}

/// A panel of the figure of histories.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct HistoryPanel {
    /// A column of the series, or a sum of some: `kinetic_energy + strain_energy`.
    pub column: String,
    /// Its label, with the unit.
    pub label: String,
}

impl Family {
    /// The family with what it takes over from `model`.
    pub fn over(&self, model: Option<&Self>) -> Self {
        let mut family = self.clone();
        if let Some(model) = model {
            family.scene = family.scene.or_else(|| model.scene.clone());
            family.x_label = family.x_label.or_else(|| model.x_label.clone());
            if family.x.is_empty() {
                family.x.clone_from(&model.x);
            }
            if family.axes.is_empty() {
                family.axes.clone_from(&model.axes);
            }
            family.set = model.set.clone().into_iter().chain(family.set).collect();
        }
        family
    }

    /// # Errors
    /// The first field that is missing or out of range.
    pub fn check(&self) -> Result<(), CommandError> {
        let simple = |c: char| c.is_ascii_alphanumeric() || c == '-';
        let is_simple = !self.name.is_empty() && self.name.chars().all(simple);
        for (field, is_fit, otherwise) in [
            ("name", is_simple, "must be made of letters, digits and dashes"),
            ("scene", self.scene.is_some(), "is missing"),
            ("x", !self.x.is_empty(), "is missing"),
            ("x-label", self.x_label.is_some(), "is missing"),
            ("axes", !self.axes.is_empty(), "is empty"),
        ] {
            is_fit.then_some(()).ok_or_else(|| self.refuse(field, otherwise))?;
        }
        if let Some((field, message)) = self.asked().fault(self.read.quantity.is_some()) {
            return Err(self.refuse(&field, message));
        }
        self.read.check().map_err(|error| self.misread(error))
    }

    /// What is asked of its series.
    pub fn asked(&self) -> Asked<'_> {
        Asked {
            judgements: &self.judgements,
            judged: &self.judged,
        }
    }

    /// Refuses choices among its runs, of which there are label and x, that none of them meets.
    ///
    /// # Errors
    /// `judged`, the `at` of a judgement, or `drawn`.
    pub fn check_choices(&self, runs: &[(&str, f64)]) -> Result<(), CommandError> {
        let known: Vec<f64> = runs.iter().map(|(_, x)| *x).collect();
        let drawn = || Some(("drawn".to_owned(), without_run(&self.drawn, &known)?));
        let unmet = self.asked().unmet(runs).or_else(drawn);
        unmet.map_or(Ok(()), |(field, message)| Err(self.refuse(&field, message)))
    }

    /// What a reading refuses, of the family.
    pub fn misread(&self, error: ReadingError) -> CommandError {
        match error {
            ReadingError::File(error) => error.into(),
            ReadingError::Unfit { field: "", message } => self.refuse("read", message),
            ReadingError::Unfit { field, message } => self.refuse(&format!("read.{field}"), message),
            error => self.refuse("read", error.to_string()),
        }
    }

    /// The error for a field of the family.
    pub fn refuse(&self, field: &str, message: impl Into<String>) -> CommandError {
        refusal(&format!("families.{}.{field}", self.name), message)
    }
}
