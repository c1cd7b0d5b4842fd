//! Which number is read from a run.

use std::collections::BTreeMap;

use mpm_scenes::{Series, ValidationRow};
use serde::Deserialize;
use toml::Table;

use super::overrides;

/// f (r + o + Σ c_k s_k) with a number r of the run, a factor f, an offset o, and multiples c_k of numbers s_k of the scene.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Reading {
    /// r is what validation.csv measured under this name.
    pub quantity: Option<String>,
    /// r is taken from this column of the series.
    pub column: Option<String>,
    /// What of the column; the last value if absent.
    pub take: Option<Take>,
    /// f, 1 if absent.
    pub factor: Option<f64>,
    /// o, 0 if absent.
    pub offset: Option<f64>,
    /// c_k by the dotted keys of s_k.
    #[serde(default)]
    pub offsets: BTreeMap<String, f64>,
}

/// What of a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Take {
    /// Its last value.
    #[default]
    Last,
    /// Its largest value.
    Largest,
    /// Its least value.
    Least,
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
    /// Refuses a reading of nothing, or of two things; the answer is the field and what is wrong with it.
    pub fn check(&self) -> Result<(), (&'static str, String)> {
        match (&self.quantity, &self.column) {
            (Some(_), Some(_)) | (None, None) => Err(("read", "needs either `quantity` or `column`".to_owned())),
            (Some(_), None) if self.take.is_some() => Err(("read.take", "belongs to a `column`".to_owned())),
            _ => Ok(()),
        }
    }

    /// What it is called in results.csv.
    pub fn name(&self) -> &str {
        self.quantity.as_deref().or(self.column.as_deref()).unwrap_or_default()
    }

    /// Reads the number of a run of `scene`; an error is the field and what is wrong with it.
    pub fn read(
        &self,
        scene: &Table,
        validation: &[ValidationRow],
        series: &Series,
    ) -> Result<Measured, (&'static str, String)> {
        let shift = self.shift(scene)?;
        let factor = self.factor.unwrap_or(1.0);
        if let Some(name) = &self.quantity {
            let row = validation.iter().find(|row| row.quantity == *name);
            let known = || validation.iter().map(|row| row.quantity.as_str());
            let row = row.ok_or_else(|| ("read.quantity", missing(name, known())))?;
            return Ok(Measured {
                value: factor * (row.measured + shift),
                reference: Some(factor * (row.reference + shift)),
                tolerance: Some(factor.abs() * row.tolerance),
            });
        }
        let name = self.name();
        let known = || series.columns().iter().map(String::as_str);
        let column = series
            .column(name)
            .ok_or_else(|| ("read.column", missing(name, known())))?;
        let value = match self.take.unwrap_or_default() {
            Take::Last => column.last().copied(),
            Take::Largest => column.iter().copied().reduce(f64::max),
            Take::Least => column.iter().copied().reduce(f64::min),
        };
        Ok(Measured {
            value: factor * (value.unwrap_or(f64::NAN) + shift),
            reference: None,
            tolerance: None,
        })
    }

    /// o + Σ c_k s_k.
    pub fn shift(&self, scene: &Table) -> Result<f64, (&'static str, String)> {
        self.offsets
            .iter()
            .try_fold(self.offset.unwrap_or(0.0), |sum, (key, factor)| {
                let number = overrides::number(scene, key);
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
    use super::*;

    fn reading(text: &str) -> Reading {
        toml::from_str(text).unwrap()
    }

    fn series() -> Series {
        let mut series = Series::new(vec!["time".to_owned(), "upper_x".to_owned()]);
        for (time, x) in [(0.0, 0.9), (1.0, 2.5), (2.0, 2.25)] {
            series.push(vec![time, x]);
        }
        series
    }

    #[test]
    fn a_column_is_shifted_by_numbers_of_the_scene() {
        let scene: Table = "grid = { spacing = 0.4 }".parse().unwrap();
        let run_out = "column = \"upper_x\"\nfactor = 0.5\noffset = -1.0\noffsets = { \"grid.spacing\" = 0.25 }";
        let value = |take: &str| {
            reading(&format!("{run_out}{take}"))
                .read(&scene, &[], &series())
                .unwrap()
                .value
        };
        assert!((value("") - 0.5 * (2.25 - 1.0 + 0.1)).abs() < 1e-15);
        assert!((value("\ntake = \"largest\"") - 0.5 * (2.5 - 1.0 + 0.1)).abs() < 1e-15);
        assert!((value("\ntake = \"least\"") - 0.5 * (0.9 - 1.0 + 0.1)).abs() < 1e-15);
    }

    #[test]
    fn a_quantity_brings_what_it_is_compared_with() {
        let rows = [ValidationRow::near("period", 1.01, 1.0, 0.02)];
        let measured = reading("quantity = \"period\"\nfactor = -100.0")
            .read(&Table::new(), &rows, &series())
            .unwrap();
        assert_eq!(
            (measured.value, measured.reference, measured.tolerance),
            (-101.0, Some(-100.0), Some(2.0))
        );
    }

    #[test]
    fn what_is_missing_is_named_with_what_there_is() {
        let rows = [ValidationRow::near("period", 1.01, 1.0, 0.02)];
        let message =
            |text: &str, rows: &[ValidationRow]| reading(text).read(&Table::new(), rows, &series()).unwrap_err();
        assert_eq!(
            message("quantity = \"tip\"", &rows),
            ("read.quantity", "`tip` is none of `period`".to_owned())
        );
        assert!(message("quantity = \"tip\"", &[]).1.contains("no reference"));
        assert_eq!(
            message("column = \"y\"", &rows),
            ("read.column", "`y` is none of `time`, `upper_x`".to_owned())
        );
        assert_eq!(
            message("column = \"time\"\noffsets = { h = 1.0 }", &rows).0,
            "read.offsets"
        );
        assert!(reading("take = \"last\"").check().is_err());
        assert!(reading("quantity = \"a\"\ncolumn = \"b\"").check().is_err());
        assert!(reading("quantity = \"a\"\ntake = \"last\"").check().is_err());
    }
}
