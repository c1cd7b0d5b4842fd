//! Which number is read from a run.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;
use toml::Table;

use super::{ReadingError, Take, curve, displacement_error};
use crate::output::read_series;
use crate::variation::{PreparedScene, SceneDocument};
use crate::{Observer, Outcome, Series, SimulationError, Summary, simulate};

/// A run that came to its end.
pub struct FinishedRun<'a> {
    /// Its scene.
    pub prepared: &'a PreparedScene,
    /// Where its files are.
    pub directory: PathBuf,
    /// How it ended.
    pub summary: Summary,
    /// Its time series.
    pub series: Series,
}

impl<'a> FinishedRun<'a> {
    /// Runs a scene to its end, or what is left of its run in the directory; `None` where the observer has stopped it.
    ///
    /// # Errors
    /// As for [`simulate`].
    pub fn of(
        prepared: &'a PreparedScene,
        directory: PathBuf,
        observer: &mut dyn Observer,
    ) -> Result<Option<Self>, SimulationError> {
        let summary = simulate(&prepared.scene, &directory, observer)?;
        if summary.outcome == Outcome::Interrupted {
            return Ok(None);
        }
        Ok(Some(Self {
            series: read_series(&directory)?,
            prepared,
            directory,
            summary,
        }))
    }
}

/// f (r + o + Σ c_k s_k) with a number r of the run, a factor f, an offset o, and multiples c_k of numbers s_k of the scene.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Reading {
    /// r is what validation.csv measured under this name.
    pub quantity: Option<String>,
    /// r is taken from this column of the series, or a sum of some: `kinetic_energy + strain_energy`.
    pub column: Option<String>,
    /// What of the column; the last value if absent.
    pub take: Option<Take>,
    /// A column (or a sum): r is divided by its largest absolute value.
    pub over: Option<String>,
    /// r is read from the particles of all frames.
    pub particles: Option<ParticleReading>,
    /// The run that differences are taken to.
    pub against: Option<OtherRun>,
    /// f, 1 if absent.
    pub factor: Option<f64>,
    /// o, 0 if absent.
    pub offset: Option<f64>,
    /// c_k by the dotted keys of s_k.
    #[serde(default)]
    pub offsets: BTreeMap<String, f64>,
}

/// What of the particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ParticleReading {
    /// The root mean square error of displacements over particles and frames, over the largest displacement; beside the other run, or without one beside the exact solution.
    DisplacementError,
}

/// The run that another is compared with.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct OtherRun {
    /// What it is called.
    pub label: String,
    /// Its scene's file, relative to the configuration's; if absent, the scene of the case with its changes.
    pub scene: Option<String>,
    /// Changes: values by dotted keys.
    #[serde(default)]
    pub set: Table,
    /// Dotted keys that are removed.
    #[serde(default)]
    pub drop: Vec<String>,
}

/// A number of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// What validation.csv compares it with.
    pub reference: Option<f64>,
    /// How far from the reference it may be.
    pub tolerance: Option<f64>,
}

impl Reading {
    /// Refuses a reading of nothing, of two things, of a difference to nothing, or with a number that is none.
    ///
    /// # Errors
    /// [`ReadingError::Unfit`].
    pub fn check(&self) -> Result<(), ReadingError> {
        let mut given = self.offsets.values().chain(&self.factor).chain(&self.offset);
        if given.any(|number| number.is_nan()) {
            return Err(unfit("", "NaN: `factor`, `offset` and `offsets` must be numbers"));
        }
        let kinds = [self.quantity.is_some(), self.column.is_some(), self.particles.is_some()];
        if kinds.iter().filter(|&&given| given).count() != 1 {
            let expected = "needs one of `quantity`, `column` and `particles`";
            return Err(unfit("", expected));
        }
        if self.take.is_some() && self.column.is_none() {
            return Err(unfit("take", "belongs to a `column`"));
        }
        let compares = self.take.is_some_and(Take::compares);
        match &self.against {
            None if compares => Err(unfit("against", "is missing")),
            Some(_) if !compares && self.particles.is_none() => {
                Err(unfit("against", "belongs to differences and errors of displacements"))
            }
            _ => Ok(()),
        }
    }

    /// What it is called in tables.
    pub fn name(&self) -> &str {
        let particles = self.particles.map(|_| "displacement error");
        let named = self.quantity.as_deref().or(self.column.as_deref());
        named.or(particles).unwrap_or_default()
    }

    /// Reads the number of a run.
    ///
    /// # Errors
    /// [`ReadingError::File`] for files that cannot be read, [`ReadingError::Unfit`] for a field that does not fit the run.
    pub fn read(&self, run: &FinishedRun, other: Option<&FinishedRun>) -> Result<Measured, ReadingError> {
        if self.particles.is_none() {
            return self.read_numbers(run, other);
        }
        let other = other.map(|other| other.directory.as_path());
        match displacement_error(&run.prepared.scene, &run.directory, other) {
            Ok(error) => self.scaled(&run.prepared.document, error),
            Err(ReadingError::Lacks(what)) => Err(unfit("particles", what)),
            Err(error) => Err(error),
        }
    }

    /// What needs no frames.
    fn read_numbers(&self, run: &FinishedRun, other: Option<&FinishedRun>) -> Result<Measured, ReadingError> {
        if let Some(name) = &self.quantity {
            let validation = &run.summary.validation;
            let row = validation.iter().find(|row| row.quantity == *name);
            let known = || validation.iter().map(|row| row.quantity.as_str());
            let row = row.ok_or_else(|| unfit("quantity", missing(name, known())))?;
            let (shift, factor) = (self.shift(&run.prepared.document)?, self.factor.unwrap_or(1.0));
            return Ok(Measured {
                value: factor * (row.measured + shift),
                reference: Some(factor * (row.reference + shift)),
                tolerance: Some(factor.abs() * row.tolerance),
            });
        }
        let column = |run: &FinishedRun, columns: &str, field: &'static str| {
            curve(&run.series, columns).map_err(|message| unfit(field, message))
        };
        let own = column(run, self.name(), "column")?;
        let other = other.map(|other| column(other, self.name(), "column")).transpose()?;
        let mut value = self.take.unwrap_or_default().of(&own, other.as_ref());
        if let Some(over) = &self.over {
            value /= column(run, over, "over")?.peak();
        }
        self.scaled(&run.prepared.document, value)
    }

    /// f (r + o + Σ c_k s_k).
    fn scaled(&self, scene: &SceneDocument, value: f64) -> Result<Measured, ReadingError> {
        Ok(Measured {
            value: self.factor.unwrap_or(1.0) * (value + self.shift(scene)?),
            reference: None,
            tolerance: None,
        })
    }

    /// o + Σ c_k s_k.
    ///
    /// # Errors
    /// [`ReadingError::Unfit`] for a key at which the scene has no number.
    pub fn shift(&self, scene: &SceneDocument) -> Result<f64, ReadingError> {
        self.offsets
            .iter()
            .try_fold(self.offset.unwrap_or(0.0), |sum, (key, factor)| {
                let number = scene.number(key);
                let number = number.ok_or_else(|| unfit("offsets", format!("`{key}` is no number of the scene")))?;
                Ok(sum + factor * number)
            })
    }
}

fn unfit(field: &'static str, message: impl Into<String>) -> ReadingError {
    let message = message.into();
    ReadingError::Unfit { field, message }
}

fn missing<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    if known.is_empty() {
        return format!("`{name}` is not there: the scene has no reference");
    }
    format!("`{name}` is none of `{}`", known.join("`, `"))
}
