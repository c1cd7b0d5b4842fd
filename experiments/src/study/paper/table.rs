//! Rows by their cases, and what is said of several of them.

use std::collections::HashMap;

use super::{Paper, Setting};
use crate::study::prelude::*;

/// Two ED² are equal for the report if neither is more than so many times the other.
pub const TIE: f64 = 1.1;

/// ED² at the end, relative to independent draws.
pub const RATIO: Computed = |row| Some(row.number("final_energy")? / row.number("energy_level")?);
/// The least ED², relative to independent draws.
pub const BEST_RATIO: Computed = |row| Some(row.number("best_energy")? / row.number("energy_level")?);
/// ED² of the start, relative to independent draws.
pub const START_RATIO: Computed = |row| Some(row.number("start_energy")? / row.number("energy_level")?);

/// Whether a run is at least as good as independent draws.
pub fn is_good(row: &Row) -> bool {
    RATIO(row).is_some_and(|ratio| ratio <= 1.0)
}

/// All rows by the names of their cases.
pub struct Findings<'a> {
    /// The study.
    pub study: &'a Paper,
    rows: HashMap<&'a str, &'a Row>,
}

impl<'a> Findings<'a> {
    /// Looks rows up.
    pub fn new(study: &'a Paper, rows: &Rows<'a>) -> Self {
        let rows = rows.iter().map(|row| (row.case(), row)).collect();
        Self { study, rows }
    }

    /// Those of the cases that have rows.
    pub fn of(&self, cases: Vec<Setting>) -> Rows<'a> {
        let found = |case: &Setting| self.rows.get(case.id().as_str()).copied();
        cases.iter().filter_map(found).collect()
    }

    /// The base.
    pub fn base(&self) -> Result<Rows<'a>, CommandError> {
        Ok(self.of(self.study.base_cases()?))
    }

    /// The rivals.
    pub fn rivals(&self) -> Result<Rows<'a>, CommandError> {
        Ok(self.of(self.study.rival_cases()?))
    }

    /// The rows of a case of the configuration; none if it has no such case.
    pub fn sweep(&self, name: &str) -> Result<Rows<'a>, CommandError> {
        let mut sweeps = self.study.sweeps.iter();
        let sweep = sweeps.find(|sweep| sweep.name.as_deref() == Some(name));
        Ok(self.of(sweep.map_or(Ok(Vec::new()), |sweep| self.study.cases_of(sweep))?))
    }
}

/// The median; a run without the quantity counts as infinitely far. `None` without runs.
pub fn median(rows: &Rows<'_>, quantity: impl Quantity) -> Option<f64> {
    let mut values: Vec<f64> = rows
        .iter()
        .map(|row| quantity.of(row).unwrap_or(f64::INFINITY))
        .collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len().checked_sub(1)? / 2;
    let upper = values[values.len() / 2];
    Some(0.5 * (values[middle] + upper))
}

/// A median for a table.
pub fn cell(value: Option<f64>) -> String {
    match value {
        Some(value) if value.is_infinite() => "∞".to_owned(),
        value => value.cell(),
    }
}

/// What tells settings apart: the columns with the symbols that stand before their values.
const PARTS: [(&str, &str); 11] = [
    ("method", ""),
    ("variant", ""),
    ("material", ""),
    ("schedule", "α "),
    ("score", "force at "),
    ("volumes", "V⁰ "),
    ("friction", "friction "),
    ("spacing", "h "),
    ("time_step", "Δt "),
    ("particles", "M "),
    ("steps", "T "),
];

/// A value as a setting names it.
fn part(row: &Row, column: &str) -> String {
    let number = |number: f64| number.to_string();
    match row.text(column) {
        "" => row.number(column).map_or("default".to_owned(), number),
        text => text.to_owned(),
    }
}

/// The rows by what differs among their settings, target and seed apart, in the order of the cases.
pub fn groups<'a>(rows: &Rows<'a>) -> Vec<(String, Rows<'a>)> {
    // Of rivals only method and size are settings.
    let of_rivals = rows.first().is_some_and(|row| row.text("variant").is_empty());
    let differs = |column: &str| {
        rows.iter().any(|row| {
            rows.first()
                .is_some_and(|first| row.value(column) != first.value(column))
        })
    };
    // The methods are named even where there is only one.
    let is_told = |(column, _): &(&str, &str)| match *column {
        "method" => true,
        "variant" => !of_rivals,
        "particles" => differs("particles"),
        column => !of_rivals && differs(column),
    };
    let told: Vec<(&str, &str)> = PARTS.into_iter().filter(is_told).collect();
    let label = |row: &Row| {
        let parts = told
            .iter()
            .map(|(column, symbol)| format!("{symbol}{}", part(row, column)));
        parts.collect::<Vec<_>>().join(", ")
    };
    let of = |name: String| {
        let here = rows.having(|row| label(row) == name);
        (name, here)
    };
    each_once(rows.iter().map(label)).into_iter().map(of).collect()
}

/// A line per setting, over targets and seeds.
pub fn settings(rows: &Rows<'_>, page: &mut Page) {
    let line = |(label, here): (String, Rows<'_>)| {
        // Rivals are not looked at on their way.
        let seen = here.iter().any(|row| !row.text("variant").is_empty());
        let on_the_way = seen.then(|| cell(median(&here, BEST_RATIO)));
        let least = here.values(RATIO).into_iter().min_by(f64::total_cmp);
        let ratio = cell(median(&here, RATIO));
        let mut cells = line(&[
            &label,
            &here.finished(),
            &ratio,
            &least,
            &on_the_way,
            &here.count(is_good),
        ]);
        let ends = ["final_sliced", "final_mean", "final_deviation"];
        cells.extend(ends.map(|quantity| cell(median(&here, quantity))));
        cells.extend(["evaluations", SECONDS].map(|quantity| here.quantile(quantity, 0.5).cell()));
        cells
    };
    let header = "setting | ended | ED² | least | on the way | ≤ 1 | sliced W2 | mean | sd | evaluations | time (s)";
    page.table(header, groups(rows).into_iter().map(line));
}

/// How many runs are better than, as good as and worse than their counterparts, and of how many pairs both gave nothing; a run without particles is worse than any other.
pub fn against<'a>(pairs: impl IntoIterator<Item = (&'a Row, &'a Row)>) -> [usize; 4] {
    let mut counts = [0; 4];
    for (row, other) in pairs {
        let place = match (RATIO(row), RATIO(other)) {
            (None, None) => 3,
            (None, Some(_)) => 2,
            (Some(_), None) => 0,
            (Some(own), Some(theirs)) if own * TIE < theirs => 0,
            (Some(own), Some(theirs)) if own <= theirs * TIE => 1,
            (Some(_), Some(_)) => 2,
        };
        counts[place] += 1;
    }
    counts
}
