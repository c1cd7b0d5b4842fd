//! A line of results: cells by the names of their columns.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::Value;

/// What one case gave, by the names of the columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    cells: BTreeMap<Cow<'static, str>, Value>,
}

impl Row {
    /// The row of a case of this name, which is in the column `case`.
    pub fn of(case: impl Into<Value>) -> Self {
        Self::default().with("case", case)
    }

    /// The same with one cell more.
    pub fn with(mut self, column: impl Into<Cow<'static, str>>, value: impl Into<Value>) -> Self {
        self.set(column, value);
        self
    }

    /// Fills a cell.
    pub fn set(&mut self, column: impl Into<Cow<'static, str>>, value: impl Into<Value>) {
        self.cells.insert(column.into(), value.into());
    }

    /// The name of the case.
    pub fn case(&self) -> &str {
        self.text("case")
    }

    /// A cell.
    pub fn value(&self, column: &str) -> &Value {
        self.cells.get(column).unwrap_or(&Value::Empty)
    }

    /// A word; empty where there is none.
    pub fn text(&self, column: &str) -> &str {
        match self.value(column) {
            Value::Text(text) => text,
            _ => "",
        }
    }

    /// A number.
    pub fn number(&self, column: &str) -> Option<f64> {
        self.value(column).number()
    }

    /// A whole number.
    pub fn count(&self, column: &str) -> Option<usize> {
        match self.value(column) {
            Value::Count(count) => usize::try_from(*count).ok(),
            _ => None,
        }
    }

    /// Whether a cell holds this.
    pub fn is(&self, column: &str, value: impl Into<Value>) -> bool {
        *self.value(column) == value.into()
    }

    /// Whether a number is at most so much; not where there is none.
    pub fn is_within(&self, column: &str, most: f64) -> bool {
        self.number(column).is_some_and(|number| number <= most)
    }
}
