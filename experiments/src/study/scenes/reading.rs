//! Which number is read from a run.

use std::collections::BTreeMap;

use mpm_scenes::reading::{ReadingError, Take, curve, displacement_error};
use mpm_scenes::scene::keys;
use serde::Deserialize;
use toml::Table;

use super::FinishedRun;
use crate::CommandError;

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

/// A field of the reading, and what is wrong with it.
type Refused = (&'static str, String);

impl Reading {
    /// Refuses a reading of nothing, of two things, or of a difference to nothing.
    pub fn check(&self) -> Result<(), Refused> {
        let kinds = [self.quantity.is_some(), self.column.is_some(), self.particles.is_some()];
        if kinds.iter().filter(|&&given| given).count() != 1 {
            let expected = "needs one of `quantity`, `column` and `particles`";
            return Err(("read", expected.to_owned()));
        }
        if self.take.is_some() && self.column.is_none() {
            return Err(("read.take", "belongs to a `column`".to_owned()));
        }
        let compares = self.take.is_some_and(Take::compares);
        match &self.against {
            None if compares => Err(("read.against", "is missing".to_owned())),
            Some(_) if !compares && self.particles.is_none() => {
                let expected = "belongs to differences and errors of displacements";
                Err(("read.against", expected.to_owned()))
            }
            _ => Ok(()),
        }
    }

    /// What it is called in results.csv.
    pub fn name(&self) -> &str {
        let particles = self.particles.map(|_| "displacement error");
        let named = self.quantity.as_deref().or(self.column.as_deref());
        named.or(particles).unwrap_or_default()
    }

    /// Reads the number of a run.
    ///
    /// # Errors
    /// Files that cannot be read; inside, a field that does not fit the run.
    pub fn read(
        &self,
        run: &FinishedRun,
        other: Option<&FinishedRun>,
    ) -> Result<Result<Measured, Refused>, CommandError> {
        if self.particles.is_none() {
            return Ok(self.read_numbers(run, other));
        }
        let other = other.map(|other| other.directory.as_path());
        match displacement_error(&run.prepared.scene, &run.directory, other) {
            Ok(error) => Ok(self.scaled(&run.prepared.table, error)),
            Err(ReadingError::File(error)) => Err(error.into()),
            Err(error) => Ok(Err(("read.particles", error.to_string()))),
        }
    }

    /// What needs no frames.
    fn read_numbers(&self, run: &FinishedRun, other: Option<&FinishedRun>) -> Result<Measured, Refused> {
        let scene = &run.prepared.table;
        if let Some(name) = &self.quantity {
            let validation = &run.summary.validation;
            let row = validation.iter().find(|row| row.quantity == *name);
            let known = || validation.iter().map(|row| row.quantity.as_str());
            let row = row.ok_or_else(|| ("read.quantity", missing(name, known())))?;
            let (shift, factor) = (self.shift(scene)?, self.factor.unwrap_or(1.0));
            return Ok(Measured {
                value: factor * (row.measured + shift),
                reference: Some(factor * (row.reference + shift)),
                tolerance: Some(factor.abs() * row.tolerance),
            });
        }
        let column = |run: &FinishedRun, columns: &str, field: &'static str| {
            let known = || run.series.columns().iter().map(String::as_str);
            curve(&run.series, columns).map_err(|name| (field, missing(&name, known())))
        };
        let own = column(run, self.name(), "read.column")?;
        let other = other
            .map(|other| column(other, self.name(), "read.column"))
            .transpose()?;
        let mut value = self.take.unwrap_or_default().of(&own, other.as_ref());
        if let Some(over) = &self.over {
            value /= column(run, over, "read.over")?.peak();
        }
        self.scaled(scene, value)
    }

    /// f (r + o + Σ c_k s_k).
    fn scaled(&self, scene: &Table, value: f64) -> Result<Measured, Refused> {
        Ok(Measured {
            value: self.factor.unwrap_or(1.0) * (value + self.shift(scene)?),
            reference: None,
            tolerance: None,
        })
    }

    /// o + Σ c_k s_k.
    pub fn shift(&self, scene: &Table) -> Result<f64, Refused> {
        self.offsets
            .iter()
            .try_fold(self.offset.unwrap_or(0.0), |sum, (key, factor)| {
                let number = keys::number(scene, key);
                let number = number.ok_or_else(|| ("read.offsets", format!("`{key}` is no number of the scene")))?;
                Ok(sum + factor * number)
            })
    }
}

fn missing<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    if known.is_empty() {
        return format!("`{name}` is not there: the scene has no reference");
    }
    format!("`{name}` is none of `{}`", known.join("`, `"))
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use mpm_scenes::{Outcome, Scene, Series, Summary, ValidationRow};

    use super::super::scene_files::PreparedScene;
    use super::*;

    const BAR: &str = include_str!("../../../scenes/vibrating_bar.toml");

    fn reading(text: &str) -> Reading {
        toml::from_str(text).unwrap()
    }

    fn scene() -> PreparedScene {
        PreparedScene {
            table: "grid = { spacing = 0.4 }".parse().unwrap(),
            scene: Scene::parse(BAR, Path::new("bar.toml")).unwrap(),
            fingerprint: String::new(),
        }
    }

    fn run<'a>(prepared: &'a PreparedScene, validation: &[ValidationRow]) -> FinishedRun<'a> {
        let mut series = Series::new(vec!["time".to_owned(), "upper_x".to_owned()]);
        for (time, x) in [(0.0, 0.9), (1.0, 2.5), (2.0, 2.25)] {
            series.push(vec![time, x]);
        }
        FinishedRun {
            prepared,
            directory: PathBuf::new(),
            summary: Summary {
                outcome: Outcome::Finished,
                steps: 1,
                steps_here: 1,
                time: 2.0,
                particles: 1,
                resumed_at: None,
                validation: validation.to_vec(),
            },
            series,
        }
    }

    #[test]
    fn a_column_is_shifted_by_numbers_of_the_scene() {
        let run_out = "column = \"upper_x\"\nfactor = 0.5\noffset = -1.0\noffsets = { \"grid.spacing\" = 0.25 }";
        let value = |take: &str| {
            let reading = reading(&format!("{run_out}{take}"));
            reading.read(&run(&scene(), &[]), None).unwrap().unwrap().value
        };
        assert!((value("") - 0.5 * (2.25 - 1.0 + 0.1)).abs() < 1e-15);
        assert!((value("\ntake = \"largest\"") - 0.5 * (2.5 - 1.0 + 0.1)).abs() < 1e-15);
        assert!((value("\ntake = \"least\"") - 0.5 * (0.9 - 1.0 + 0.1)).abs() < 1e-15);
        let over = value("\nover = \"upper_x + upper_x\"");
        assert!((over - 0.5 * (2.25 / 5.0 - 1.0 + 0.1)).abs() < 1e-15);
    }

    #[test]
    fn a_quantity_brings_what_it_is_compared_with() {
        let rows = [ValidationRow::near("period", 1.01, 1.0, 0.02)];
        let reading = reading("quantity = \"period\"\nfactor = -100.0");
        let measured = reading.read(&run(&scene(), &rows), None).unwrap().unwrap();
        assert_eq!(
            (measured.value, measured.reference, measured.tolerance),
            (-101.0, Some(-100.0), Some(2.0))
        );
    }

    #[test]
    fn what_is_missing_is_named_with_what_there_is() {
        let rows = [ValidationRow::near("period", 1.01, 1.0, 0.02)];
        let message = |text: &str, rows: &[ValidationRow]| {
            let refused = reading(text).read(&run(&scene(), rows), None).unwrap();
            refused.unwrap_err()
        };
        assert_eq!(
            message("quantity = \"tip\"", &rows),
            ("read.quantity", "`tip` is none of `period`".to_owned())
        );
        assert!(message("quantity = \"tip\"", &[]).1.contains("no reference"));
        assert_eq!(
            message("column = \"y\"", &rows),
            ("read.column", "`y` is none of `time`, `upper_x`".to_owned())
        );
        assert_eq!(message("column = \"time\"\nover = \"z\"", &rows).0, "read.over");
        assert_eq!(
            message("column = \"time\"\noffsets = { h = 1.0 }", &rows).0,
            "read.offsets"
        );
        assert!(
            message("particles = \"displacement-error\"", &[])
                .1
                .contains("no frames")
        );
    }

    #[test]
    fn half_a_reading_is_refused() {
        for (text, field) in [
            ("take = \"last\"", "read"),
            ("quantity = \"a\"\ncolumn = \"b\"", "read"),
            ("quantity = \"a\"\ntake = \"last\"", "read.take"),
            ("column = \"a\"\ntake = \"difference\"", "read.against"),
            ("column = \"a\"\nagainst = { label = \"b\" }", "read.against"),
        ] {
            assert_eq!(reading(text).check().unwrap_err().0, field, "{text}");
        }
        let difference = "column = \"a\"\ntake = \"largest-difference\"\nagainst = { label = \"b\" }";
        assert_eq!(reading(difference).check(), Ok(()));
        assert_eq!(reading("particles = \"displacement-error\"").check(), Ok(()));
    }
}
