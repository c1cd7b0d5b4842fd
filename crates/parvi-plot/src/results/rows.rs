//! Rows of results, of which parts are looked at.

use super::{Row, Value};
use crate::statistics::{summarize, weighted_quantile};

/// Some rows.
#[derive(Clone, Debug, Default)]
pub struct Rows<'a>(Vec<&'a Row>);

impl<'a> FromIterator<&'a Row> for Rows<'a> {
    fn from_iter<I: IntoIterator<Item = &'a Row>>(rows: I) -> Self {
        Self(rows.into_iter().collect())
    }
}

impl<'a> Rows<'a> {
    /// The rows one by one.
    pub fn iter(&self) -> impl Iterator<Item = &'a Row> + Clone {
        self.0.iter().copied()
    }

    /// Their number.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The first.
    pub fn first(&self) -> Option<&'a Row> {
        self.0.first().copied()
    }

    /// Those with a property.
    pub fn having(&self, property: impl Fn(&Row) -> bool) -> Self {
        self.iter().filter(|row| property(row)).collect()
    }

    /// Those that hold this in a column.
    pub fn with(&self, column: &str, value: impl Into<Value>) -> Self {
        let value = value.into();
        self.having(|row| *row.value(column) == value)
    }

    /// How many have a property.
    pub fn count(&self, property: impl Fn(&Row) -> bool) -> usize {
        self.iter().filter(|row| property(row)).count()
    }

    /// The rows by a name, in the order in which the names come first.
    pub fn by_name(&self, name: impl Fn(&Row) -> String) -> Vec<(String, Self)> {
        let mut groups: Vec<(String, Self)> = Vec::new();
        for row in self.iter() {
            let name = name(row);
            match groups.iter_mut().find(|(known, _)| *known == name) {
                Some((_, group)) => group.0.push(row),
                None => groups.push((name, Self(vec![row]))),
            }
        }
        groups
    }

    /// The rows by what they hold in a column, in the order in which that comes first.
    pub fn by(&self, column: &str) -> Vec<(String, Self)> {
        self.by_name(|row| row.value(column).to_string())
    }

    /// The same in alphabetical order, without the rows that hold nothing there.
    pub fn sorted(&self, column: &str) -> Vec<(String, Self)> {
        let mut groups = self.having(|row| *row.value(column) != Value::Empty).by(column);
        groups.sort_by(|left, right| left.0.cmp(&right.0));
        groups
    }

    /// What stands in a column, each once, in the order in which it comes first.
    pub fn words(&self, column: &str) -> Vec<String> {
        self.by(column).into_iter().map(|(word, _)| word).collect()
    }

    /// The values of a column in those rows that have it.
    pub fn values(&self, column: &str) -> Vec<f64> {
        self.iter().filter_map(|row| row.number(column)).collect()
    }

    /// The values of a column from least to most, each once.
    pub fn places(&self, column: &str) -> Vec<f64> {
        let mut places = self.values(column);
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    }

    /// The median of a column over the rows that have it.
    pub fn median(&self, column: &str) -> Option<f64> {
        summarize(&self.values(column)).ok().map(|summary| summary.median)
    }

    /// The median of a column, of an even number half-way; a row without it counts as infinitely large. `None` without rows.
    pub fn median_of_all(&self, column: &str) -> Option<f64> {
        let number = |row: &Row| row.number(column).unwrap_or(f64::INFINITY);
        let mut values: Vec<f64> = self.iter().map(number).collect();
        values.sort_by(f64::total_cmp);
        let middle = values.len().checked_sub(1)? / 2;
        Some(0.5 * (values[middle] + values[values.len() / 2]))
    }

    /// A quantile of a column over the rows that have it.
    pub fn quantile(&self, column: &str, level: f64) -> Option<f64> {
        let quantiles = weighted_quantile(&self.values(column), None, &[level]);
        quantiles.ok()?.first().copied()
    }

    /// The mean of a column over the rows that have it; not a number without any.
    pub fn mean(&self, column: &str) -> f64 {
        let values = self.values(column);
        values.iter().sum::<f64>() / values.len() as f64
    }

    /// The least value of a column.
    pub fn least(&self, column: &str) -> Option<f64> {
        self.values(column).into_iter().reduce(f64::min)
    }

    /// The largest value of a column.
    pub fn largest(&self, column: &str) -> Option<f64> {
        self.values(column).into_iter().reduce(f64::max)
    }

    /// The largest distance of a column from zero.
    pub fn farthest(&self, column: &str) -> Option<f64> {
        self.values(column).into_iter().map(f64::abs).reduce(f64::max)
    }

    /// Notes in a row the least value of a column, its median and the largest value.
    pub fn note_range(&self, column: &str, row: &mut Row, [least, median, largest]: [&'static str; 3]) {
        row.set(least, self.least(column));
        row.set(median, self.median(column));
        row.set(largest, self.largest(column));
    }

    /// The row with the largest value of a column.
    pub fn worst(&self, column: &str) -> Option<&'a Row> {
        let known = self.iter().filter_map(|row| Some((row.number(column)?, row)));
        known
            .max_by(|left, right| left.0.total_cmp(&right.0))
            .map(|(_, row)| row)
    }

    /// The value of a column whose rows have the least measure, and these rows; values without a measure are left out.
    pub fn best<V: Into<Value> + Clone>(
        &self,
        column: &str,
        values: impl IntoIterator<Item = V>,
        measure: impl Fn(&Self) -> Option<f64>,
    ) -> Option<(V, Self)> {
        let measured = values.into_iter().filter_map(|value| {
            let here = self.with(column, value.clone());
            Some((measure(&here)?, value, here))
        });
        let (_, value, here) = measured.min_by(|left, right| left.0.total_cmp(&right.0))?;
        Some((value, here))
    }
}
