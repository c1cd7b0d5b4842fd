//! Rows of a study, of which parts are looked at.

use super::each_once::each_once;
use super::report::Report;
use super::row::Row;
use super::value::Value;
use crate::options::Bounded;
use crate::plots::LineSeries;
use crate::plots::page::{Cell, Page};
use crate::statistics::{summarize, weighted_quantile};

/// A number of a row, where the row has it: a column by its name, or what is computed from some.
pub trait Quantity {
    /// The number.
    fn of(&self, row: &Row) -> Option<f64>;
}

impl Quantity for &str {
    fn of(&self, row: &Row) -> Option<f64> {
        row.number(self)
    }
}

impl<F: Fn(&Row) -> Option<f64>> Quantity for F {
    fn of(&self, row: &Row) -> Option<f64> {
        self(row)
    }
}

/// A computed quantity.
pub type Computed = fn(&Row) -> Option<f64>;

/// Squared energy distance.
pub const ENERGY: &str = "energy_distance_squared";
/// Its root, the energy distance.
pub const ENERGY_ROOT: Computed = |row| Some(row.number(ENERGY)?.max(0.0).sqrt());
/// ED² relative to independent draws.
pub const ENERGY_RATIO: Computed = |row| Some(row.number(ENERGY)? / row.number("energy_level")?);
/// SW₂.
pub const SLICED: &str = "sliced_wasserstein";
/// SW₂ relative to independent draws.
pub const SLICED_RATIO: Computed = |row| Some(row.number(SLICED)? / row.number("sliced_level")?);
/// Wall time.
pub const SECONDS: &str = "wall_seconds";
/// Evaluations of all kinds, where both are known.
pub const EVALUATIONS: Computed = |row| Some(row.number("score_evaluations")? + row.number("density_evaluations")?);
/// Active nodes per particle.
pub const NODES_PER_PARTICLE: Computed = |row| Some(row.number("active_nodes")? / row.number("particles")?);

impl<const LEAST: i64, const MOST: i64> From<Bounded<LEAST, MOST>> for Value {
    fn from(count: Bounded<LEAST, MOST>) -> Self {
        count.get().into()
    }
}

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

    /// The words of a column, each once, in the order in which they come first.
    pub fn words(&self, column: &str) -> Vec<&'a str> {
        each_once(self.iter().map(|row| row.text(column)))
    }

    /// The values of a quantity in those rows that have it.
    pub fn values(&self, quantity: impl Quantity) -> Vec<f64> {
        self.iter().filter_map(|row| quantity.of(row)).collect()
    }

    /// The median of a quantity over the rows that have it.
    pub fn median(&self, quantity: impl Quantity) -> Option<f64> {
        summarize(&self.values(quantity)).ok().map(|summary| summary.median)
    }

    /// Medians as cells of a table.
    pub fn medians(&self, quantities: &[&dyn Quantity]) -> Vec<String> {
        let median = |quantity: &&dyn Quantity| self.median(|row: &Row| quantity.of(row)).cell();
        quantities.iter().map(median).collect()
    }

    /// A quantile of a quantity over the rows that have it.
    pub fn quantile(&self, quantity: impl Quantity, level: f64) -> Option<f64> {
        let quantiles = weighted_quantile(&self.values(quantity), None, &[level]);
        quantiles.ok()?.first().copied()
    }

    /// The largest value of a quantity.
    pub fn largest(&self, quantity: impl Quantity) -> Option<f64> {
        self.values(quantity).into_iter().reduce(f64::max)
    }

    /// The row with the largest value of a quantity, and this.
    pub fn worst(&self, quantity: impl Quantity) -> Option<(f64, &'a Row)> {
        let known = self.iter().filter_map(|row| Some((quantity.of(row)?, row)));
        known.max_by(|left, right| left.0.total_cmp(&right.0))
    }

    /// How many gave particles, of how many.
    pub fn finished(&self) -> String {
        format!("{}/{}", self.count(Row::finished), self.len())
    }

    /// The runs that gave nothing, each as an item of a list.
    pub fn failures(&self) -> Vec<String> {
        self.iter().filter(|row| !row.finished()).map(Row::failure).collect()
    }

    /// The report of a page that ends with the runs that gave nothing, and how many these are.
    pub fn report(&self, mut page: Page) -> Report {
        let failed = self.failures();
        page.list("Runs that did not finish", &failed, None);
        Report::new(page).with("cases", self.len()).with("failed", failed.len())
    }
}

/// A line through the medians of a quantity over the rows at each abscissa, with bars from the least to the largest.
pub fn curve<'a>(
    label: impl Into<String>,
    points: impl IntoIterator<Item = (f64, Rows<'a>)>,
    quantity: impl Quantity,
) -> LineSeries {
    let mut line = LineSeries::named(label);
    for (x, rows) in points {
        line.push_median(x, &rows.values(|row: &Row| quantity.of(row)));
    }
    line
}
