//! A line of a table: what stands in the places of its cells.

use std::borrow::Cow;

use super::cell::{Cell, MISSING};
use crate::results::{Contest, Row, Rows, Value};

/// What a line of a table is of.
#[derive(Clone, Debug, Default)]
pub struct Line<'a> {
    /// Rows of results, whose statistics stand in it.
    pub rows: Rows<'a>,
    named: Vec<(Cow<'static, str>, String)>,
}

impl<'a> Line<'a> {
    /// The same with a value of its own, which stands before a statistic of this name.
    pub fn with(mut self, name: impl Into<Cow<'static, str>>, value: impl Cell) -> Self {
        self.named.push((name.into(), value.cell()));
        self
    }

    /// The same with several of them.
    pub fn with_all(self, named: impl IntoIterator<Item = (String, impl Cell)>) -> Self {
        named
            .into_iter()
            .fold(self, |line, (name, value)| line.with(name, value))
    }

    /// The same with the numbers of a contest: `better`, `ties`, `worse`, and `neither`.
    pub fn with_contest(self, contest: Contest) -> Self {
        let line = self.with("better", contest.better).with("ties", contest.ties);
        line.with("worse", contest.worse).with("neither", contest.neither)
    }

    /// The same with statistics of other rows, behind a word.
    pub fn with_cells<const N: usize>(self, word: &str, rows: &Rows<'_>, statistics: [&str; N]) -> Self {
        self.with_all(statistics.map(|statistic| (format!("{word} {statistic}"), rows.cell(statistic))))
    }

    /// A line for each value that a column may hold, which names it, of the rows that hold it.
    pub fn by<V: Into<Value>>(&self, column: &'static str, values: impl IntoIterator<Item = V>) -> Vec<Self> {
        let of = |value: Value| {
            let rows = self.rows.with(column, value.clone());
            let line = Self { rows, ..self.clone() };
            line.with(column, value.to_string())
        };
        values.into_iter().map(|value| of(value.into())).collect()
    }

    /// The cells: texts with statistics in braces.
    pub(super) fn cells(&self, texts: &[String]) -> Vec<String> {
        texts.iter().map(|text| self.cell(text)).collect()
    }

    fn cell(&self, text: &str) -> String {
        let (cell, [places, missing]) = self.with_places(text);
        if places > 0 && missing == places {
            return MISSING.to_owned();
        }
        cell.replace(&format!(" ({MISSING})"), "")
    }

    /// A text with statistics in braces.
    pub(super) fn filled(&self, text: &str) -> String {
        self.with_places(text).0
    }

    /// The first of some texts for whose places there is something, else the last.
    pub(super) fn item(&self, texts: &[String]) -> String {
        let is_whole = |text: &&String| self.with_places(text).1[1] == 0;
        let text = texts.iter().find(is_whole).or(texts.last());
        text.map(|text| self.filled(text)).unwrap_or_default()
    }

    /// The same with the number of its places, and of those for which there is nothing.
    fn with_places(&self, text: &str) -> (String, [usize; 2]) {
        let mut parts = text.split('{');
        let mut filled = parts.next().unwrap_or_default().to_owned();
        let (mut places, mut missing) = (0, 0);
        for part in parts {
            let (name, rest) = part.split_once('}').unwrap_or((part, ""));
            let own = self.named.iter().find(|(known, _)| *known == name);
            let value = own.map_or_else(|| self.rows.cell(name), |(_, value)| value.clone());
            places += 1;
            missing += usize::from(value == MISSING);
            filled.push_str(&value);
            filled.push_str(rest);
        }
        (filled, [places, missing])
    }
}

impl<'a> From<Rows<'a>> for Line<'a> {
    fn from(rows: Rows<'a>) -> Self {
        Self {
            rows,
            ..Self::default()
        }
    }
}

impl<'a> From<&'a Row> for Line<'a> {
    fn from(row: &'a Row) -> Self {
        Rows::from_iter([row]).into()
    }
}

impl<'a> Rows<'a> {
    /// A line for each value that a column may hold, which names it, of the rows that hold it.
    pub fn lines<V: Into<Value>>(&self, column: &'static str, values: impl IntoIterator<Item = V>) -> Vec<Line<'a>> {
        Line::from(self.clone()).by(column, values)
    }

    /// A line for each combination that there is of what stands in some columns, which names it, in the order in which these come first.
    pub fn lines_of<const N: usize>(&self, columns: [&'static str; N]) -> Vec<Line<'a>> {
        let told = |line: Line<'a>, column: &'static str| {
            let groups = line.rows.by(column).into_iter();
            groups.map(move |(word, rows)| Line { rows, ..line.clone() }.with(column, word))
        };
        let first = vec![Line::from(self.clone())];
        columns.into_iter().fold(first, |lines, column| {
            lines.into_iter().flat_map(|line| told(line, column)).collect()
        })
    }

    /// The same for each value of one column with each of another.
    pub fn lines_by<V: Into<Value>, W: Into<Value>>(
        &self,
        (column, values): (&'static str, impl IntoIterator<Item = V>),
        (inner, inner_values): (&'static str, impl IntoIterator<Item = W> + Clone),
    ) -> Vec<Line<'a>> {
        let lines = self.lines(column, values).into_iter();
        lines.flat_map(|line| line.by(inner, inner_values.clone())).collect()
    }
}

/// The values that the columns of a name are repeated for.
pub fn each<T: ToString>(name: &str, values: impl IntoIterator<Item = T>) -> (&str, Vec<String>) {
    (name, values.into_iter().map(|value| value.to_string()).collect())
}
