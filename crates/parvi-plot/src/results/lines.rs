//! Lines through rows.

use super::{Row, Rows, Value};
use crate::{LineSeries, MultiplesPanel};

impl Rows<'_> {
    /// Two columns of all rows; what a row does not have is not finite.
    pub fn pairs(&self, x: &str, y: &str) -> Vec<(f64, f64)> {
        let number = |row: &Row, column: &str| row.number(column).unwrap_or(f64::NAN);
        self.iter().map(|row| (number(row, x), number(row, y))).collect()
    }

    /// The same for each value of a third column, from least to most.
    pub fn pairs_by(&self, column: &str, x: &str, y: &str) -> Vec<Vec<(f64, f64)>> {
        let of = |place: f64| self.with(column, place).pairs(x, y);
        self.places(column).into_iter().map(of).collect()
    }

    /// A line through the rows that have both columns, in their order.
    pub fn line(&self, label: impl Into<String>, x: &str, y: &str) -> LineSeries {
        let points = self.iter().filter_map(|row| Some((row.number(x)?, row.number(y)?)));
        LineSeries::through(label, points)
    }

    /// A line through the medians of `y` at each value of `x`, with bars from the least to the largest.
    pub fn curve(&self, label: impl Into<String>, x: &str, y: &str) -> LineSeries {
        let mut line = LineSeries::named(label);
        for place in self.places(x) {
            line.push_median(place, &self.with(x, place).values(y));
        }
        line
    }

    /// A line through the medians of `y` over all rows at each value of `x`, a row without `y` infinitely large.
    pub fn medians(&self, label: impl Into<String>, x: &str, y: &str) -> LineSeries {
        let at = |place: f64| (place, self.with(x, place).median_of_all(y).unwrap_or(f64::NAN));
        LineSeries::through(label, self.places(x).into_iter().map(at))
    }

    /// The same for each value that there is in a column, which is its label behind a word.
    pub fn medians_by(&self, (word, column): (&str, &str), x: &str, y: &str) -> Vec<LineSeries> {
        let line = |(value, here): (String, Self)| here.medians(format!("{word}{value}"), x, y);
        self.by(column).into_iter().map(line).collect()
    }

    /// A line through the medians of two columns, a point for each value of a third.
    pub fn path(&self, label: impl Into<String>, by: &str, x: &str, y: &str) -> LineSeries {
        let point = |(_, here): (String, Self)| Some((here.median(x)?, here.median(y).unwrap_or(f64::NAN)));
        LineSeries::through(label, self.by(by).into_iter().filter_map(point))
    }

    /// A curve for each value that a column may hold, which is its label behind a word.
    pub fn curves<V: Into<Value>>(
        &self,
        (word, column): (&str, &str),
        values: impl IntoIterator<Item = V>,
        x: &str,
        y: &str,
    ) -> Vec<LineSeries> {
        let curve = |value: Value| self.with(column, value.clone()).curve(format!("{word}{value}"), x, y);
        values.into_iter().map(|value| curve(value.into())).collect()
    }

    /// A line for each value that a column may hold, which is its label: the values of `y` in order of size against the share of all that are no larger; `all` may be
    /// more than have one.
    pub fn orders<V: Into<Value>>(
        &self,
        column: &str,
        values: impl IntoIterator<Item = V>,
        y: &str,
        all: Option<usize>,
    ) -> Vec<LineSeries> {
        let order = |value: Value| {
            let numbers = self.with(column, value.clone()).values(y);
            let all = all.unwrap_or(numbers.len());
            LineSeries::in_order(value.to_string(), numbers, all)
        };
        values.into_iter().map(|value| order(value.into())).collect()
    }

    /// A panel of the rows that hold it for each value that a column may hold, which is its title behind a word.
    pub fn panels<V: Into<Value>>(
        &self,
        (word, column): (&str, &str),
        values: impl IntoIterator<Item = V>,
        panel: impl Fn(&Self) -> MultiplesPanel,
    ) -> Vec<MultiplesPanel> {
        let of = |value: Value| MultiplesPanel {
            title: format!("{word}{value}"),
            ..panel(&self.with(column, value))
        };
        values.into_iter().map(|value| of(value.into())).collect()
    }
}
